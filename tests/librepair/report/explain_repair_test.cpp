// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include <repair/explain_repair.h>
#include <repair/repair.h>

#include "shapes.h"

namespace meshrepair {
namespace {

using namespace testing;

struct Explained {
  RepairExplanation explanation;
  RepairReport report;

  [[nodiscard]] std::size_t count(TriangleFate fate) const {
    return static_cast<std::size_t>(
        std::count(explanation.fates.begin(), explanation.fates.end(), fate));
  }
  [[nodiscard]] std::size_t count(TriangleOrigin origin) const {
    return static_cast<std::size_t>(
        std::count(explanation.origins.begin(), explanation.origins.end(), origin));
  }
};

Explained explained(const TriangleSoup& soup, RepairOptions options = {}) {
  options.explain = true;
  const RepairResult result = repair(soup, options);
  EXPECT_EQ(result.report.explanation.fates.size(), soup.triangles.size());
  EXPECT_EQ(result.report.explanation.origins.size(), result.surface.mesh.triangles.size());
  return {result.report.explanation, result.report};
}

TEST(ExplainRepair, AValidSolidIsWhole) {
  const Explained one = explained(cube());
  EXPECT_TRUE(one.report.kept_valid);
  EXPECT_EQ(one.count(TriangleFate::whole), 12u);
  EXPECT_EQ(one.count(TriangleOrigin::whole), 12u);
}

TEST(ExplainRepair, WhatFacesInwardIsTurned) {
  EXPECT_EQ(explained(flipped(cube())).count(TriangleFate::turned), 12u);
}

TEST(ExplainRepair, PatchesAreOfNoTriangle) {
  TriangleSoup open = sphere(500);
  open.triangles.erase(open.triangles.begin() + 100);
  const Explained one = explained(open);
  EXPECT_EQ(one.count(TriangleFate::whole), open.triangles.size());
  EXPECT_EQ(one.count(TriangleOrigin::patch), 1u);
}

TEST(ExplainRepair, EachFateIsTold) {
  TriangleSoup soup = cube();
  append(soup, moved(scaled(cube(), 0.5), {0.75, 0.25, 0.25}));   // pokes out
  append(soup, moved(scaled(cube(), 0.25), {0.25, 0.25, 0.25}));  // inside
  soup.points.insert(soup.points.end(), {{3, 0, 0}, {4, 0, 0}, {3, 1, 0}});
  const auto n = static_cast<std::uint32_t>(soup.points.size());
  soup.triangles.push_back({n - 3, n - 2, n - 1});  // a sheet
  soup.triangles.push_back(soup.triangles[0]);
  soup.triangles.push_back({n - 3, n - 3, n - 1});  // without area
  const Explained one = explained(soup);
  // One side of the second cube lies in the first one, which is cut on one side.
  EXPECT_EQ(one.count(TriangleFate::inside), 12u + 2u);
  EXPECT_EQ(one.count(TriangleFate::outside), 1u);
  EXPECT_EQ(one.explanation.fates[36], TriangleFate::outside);
  EXPECT_EQ(one.explanation.fates[37], TriangleFate::duplicate);
  EXPECT_EQ(one.explanation.fates[38], TriangleFate::dropped);
  EXPECT_EQ(one.count(TriangleFate::whole), one.report.triangles.untouched);
  EXPECT_EQ(one.count(TriangleFate::cut), one.report.triangles.cut);
  EXPECT_EQ(one.count(TriangleOrigin::whole), one.report.triangles.untouched);
  EXPECT_GT(one.count(TriangleOrigin::piece), 0u);
}

TEST(ExplainRepair, SheetsBecomeWalls) {
  TriangleSoup soup = cube();
  soup.points.insert(soup.points.end(), {{3, 0, 0}, {4, 0, 0}, {3, 1, 0}});
  soup.triangles.push_back({8, 9, 10});
  RepairOptions options;
  options.thicken.thickness = 0.1;
  const Explained one = explained(soup, options);
  EXPECT_EQ(one.explanation.fates[12], TriangleFate::thickened);
  EXPECT_EQ(one.count(TriangleFate::whole), 12u);
  EXPECT_EQ(one.count(TriangleOrigin::whole), 12u);
  EXPECT_GE(one.count(TriangleOrigin::wall), 8u);
}

TEST(ExplainRepair, CornersThatWereSewnAreTold) {
  TriangleSoup soup = sphere(500);
  const auto apart = static_cast<std::uint32_t>(soup.points.size());
  soup.points.push_back(soup.points[soup.triangles[200][0]] + Vec3d(1e-4, 0, 0));
  soup.triangles[200][0] = apart;
  const Explained one = explained(soup, [] {
    RepairOptions options;
    options.sew.mode = SewMode::distance;
    options.sew.distance = 1e-3;
    return options;
  }());
  EXPECT_GT(one.report.sew.sewn_edges, 0u);
  EXPECT_GE(one.count(TriangleFate::moved), 1u);
  EXPECT_GE(one.count(TriangleFate::whole), soup.triangles.size() - 10);
}

// What can be written in single precision alone is still the triangle that it was.
TEST(ExplainRepair, RoundingCutsNothing) {
  RepairOptions options;
  options.certify.precision = Precision::float32;
  const Explained one = explained(scaled(cube(), 0.1), options);
  EXPECT_EQ(one.count(TriangleFate::whole), 12u);
  EXPECT_EQ(one.count(TriangleOrigin::whole), 12u);
}

TEST(ExplainRepair, SealsAreTold) {
  TriangleSoup soup = sphere(2000);
  append(soup, flipped(scaled(sphere(2000), 0.8)));
  const std::size_t walls = soup.triangles.size();
  // A way in: a tube with sides of its own, from the triangle at the top of the one to that of the
  // other.
  const auto top = [&](std::size_t first) {
    std::size_t best = first;
    const auto height = [&](std::size_t t) {
      double lowest = std::numeric_limits<double>::infinity();
      for (const std::uint32_t p : soup.triangles[t]) {
        lowest = std::min(lowest, soup.points[p].dot(Vec3d(0.3, 0.5, 1)));
      }
      return lowest;
    };
    for (std::size_t t = first; t < first + walls / 2; ++t) {
      if (height(t) > height(best)) best = t;
    }
    return best;
  };
  const std::size_t outer = top(0), inner = top(walls / 2);
  const auto a = soup.triangles[outer], b = soup.triangles[inner];
  ASSERT_EQ(inner - outer, walls / 2);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    // The inner one is flipped: two of its corners have changed places.
    const auto match = [&](std::uint32_t p) {
      const auto nearest = std::min_element(b.begin(), b.end(), [&](auto q, auto r) {
        return (soup.points[q] - soup.points[p]).norm() < (soup.points[r] - soup.points[p]).norm();
      });
      return *nearest;
    };
    soup.triangles.push_back({a[k], a[next], match(a[next])});
    soup.triangles.push_back({a[k], match(a[next]), match(a[k])});
  }
  soup.triangles.erase(soup.triangles.begin() + static_cast<std::ptrdiff_t>(inner));
  soup.triangles.erase(soup.triangles.begin() + static_cast<std::ptrdiff_t>(outer));
  RepairOptions options;
  options.seal.size = 0.4;
  const Explained one = explained(soup, options);
  ASSERT_EQ(one.report.seal.openings, 1u);
  EXPECT_GT(one.count(TriangleOrigin::seal), 0u);
  EXPECT_EQ(one.count(TriangleOrigin::patch), 0u);
  EXPECT_GE(one.count(TriangleFate::whole), walls / 2 - 1);
  EXPECT_GE(one.count(TriangleFate::inside), walls / 2 - 1);
}

TEST(ExplainRepair, SolidsThatGoAreLeftOut) {
  TriangleSoup soup = cube();
  append(soup, moved(scaled(cube(), 2), {5, 0, 0}));
  RepairOptions options;
  options.keep.most = 1;
  const Explained one = explained(soup, options);
  EXPECT_EQ(one.count(TriangleFate::left_out), 12u);
  EXPECT_EQ(one.explanation.fates[0], TriangleFate::left_out);
  EXPECT_EQ(one.explanation.fates[12], TriangleFate::whole);
  EXPECT_EQ(one.count(TriangleOrigin::whole), 12u);
}

TEST(ExplainRepair, NamesAreDistinct) {
  for (std::size_t i = 0; i < kTriangleFates; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_NE(fate_name(static_cast<TriangleFate>(i)), fate_name(static_cast<TriangleFate>(j)));
    }
  }
  EXPECT_EQ(origin_name(TriangleOrigin::wall), "wall");
}

}  // namespace
}  // namespace meshrepair
