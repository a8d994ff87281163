// SPDX-License-Identifier: MIT
// What rounds of certification do, and what they leave alone.
#include "surface/certify_surface.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include <gtest/gtest.h>

#include "shapes.h"
#include "surfaces.h"

namespace meshrepair {
namespace {

using namespace testing;

// A box whose lid is open by so much, and another one that crosses both.
TriangleSoup box_with_open_lid(double gap) {
  TriangleSoup soup = box({0, 0, 0}, {1, 1, 1});
  const auto first = static_cast<std::uint32_t>(soup.points.size());
  soup.points.emplace_back(0, 1, 1 + gap);
  soup.points.emplace_back(1, 1, 1 + gap);
  for (auto& t : soup.triangles) {
    const bool is_lid =
        std::all_of(t.begin(), t.end(), [&](auto p) { return soup.points[p].z() == 1; });
    for (std::uint32_t& p : t) {
      if (is_lid && soup.points[p].y() == 1) p = first + (soup.points[p].x() == 1 ? 1 : 0);
    }
  }
  append(soup, box({0.5, 0.25, 0.5}, {2, 0.75, 2}));
  return soup;
}

TEST(CertifySurface, SewsNothing) {
  constexpr double kGap = 1.0 / 64;
  const TriangleSoup soup = box_with_open_lid(kGap);
  CleanReport cleaned;
  const Grid grid = clean_soup(soup, cleaned).grid;
  RepairOptions options;
  options.sew = {.mode = SewMode::distance, .distance = 2 * kGap};
  CertifyReport report;
  SimplifyReport simplified;
  internal::Simplifier simplifier(options, simplified);
  const Surface result =
      internal::certify_surface(as_surface(soup), std::nullopt, simplifier, grid, options, report);
  EXPECT_GT(report.pairs_at_first, 0u);
  for (const Vec3d& p : result.mesh.points) {
    // Where the corners of the lid would have met those of the box.
    EXPECT_FALSE(p.y() == 1 && p.z() > 1 + kGap / 4 && p.z() < 1 + kGap * 3 / 4) << p.z();
  }
}

}  // namespace
}  // namespace meshrepair
