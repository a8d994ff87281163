// SPDX-License-Identifier: MIT
// Joints, their weights and morph targets of what a repair makes.
#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/skins.h>
#include <mesh/soup_io.h>
#include <repair/repair.h>
#include <repair/transfer_attributes.h>

#include "each_seed.h"
#include "shapes.h"
#include "textured_surface.h"

namespace meshrepair {
namespace {

using namespace testing;
using Kind = CornerAttribute::Kind;
using JointWeights = std::map<double, double>;

// Of each point up to as many joints as a value holds, whose weights add up to 1.
CornerAttribute random_skin(const TriangleSoup& soup, std::size_t sets, std::mt19937& random) {
  CornerAttribute skin;
  skin.kind = Kind::skin;
  skin.place = CornerAttribute::Place::point;
  skin.storage = CornerAttribute::Storage::real32;
  skin.components = kSkinSet * sets;
  for (std::size_t p = 0; p < soup.points.size(); ++p) {
    SkinMixer mixer(skin.components);
    for (std::size_t k = 0; k <= random() % (4 * sets); ++k) {
      mixer.add_joint(static_cast<double>(random() % 300), 1 + static_cast<double>(random() % 50));
    }
    mixer.append_to(skin.values);
  }
  for (double& value : skin.values) value = as_single(value);
  for (const auto& t : soup.triangles) {
    skin.of_corner.insert(skin.of_corner.end(), t.begin(), t.end());
  }
  return skin;
}

CornerAttribute random_target(const TriangleSoup& soup, std::mt19937& random) {
  CornerAttribute target;
  target.kind = Kind::other;
  target.name = "TARGET_0/NORMAL";
  target.place = CornerAttribute::Place::point;
  target.components = 3;
  for (std::size_t i = 0; i < 3 * soup.points.size(); ++i) {
    target.values.push_back(static_cast<double>(random() % 1000) / 1000);
  }
  for (const auto& t : soup.triangles) {
    target.of_corner.insert(target.of_corner.end(), t.begin(), t.end());
  }
  return target;
}

JointWeights weights_at(const CornerAttribute& skin, std::size_t corner) {
  JointWeights weights;
  const double* const value = skin.values.data() + skin.components * skin.of_corner[corner];
  for (std::size_t i = 0; i < skin.components; ++i) {
    const bool is_weight = i % kSkinSet >= kSkinSet / 2;
    if (is_weight && value[i] != 0) weights[value[i - kSkinSet / 2]] += value[i];
  }
  return weights;
}

double sum_of(const JointWeights& weights) {
  double sum = 0;
  for (const auto& [joint, weight] : weights) sum += weight;
  return sum;
}

// Overlapping spheres, one with a hole.
TriangleSoup random_scene(std::mt19937& random) {
  const auto place = [&] { return static_cast<double>(random() % 100) / 100; };
  TriangleSoup scene = sphere(60 + random() % 300);
  const std::size_t hole = 1 + random() % 6;
  scene.triangles.resize(scene.triangles.size() - hole);
  const double x = 0.5 + place() / 2, y = place();
  return together(scene, sphere(60 + random() % 300, 0.5 + place() / 2, {x, y, place()}));
}

void expect_sound(const CornerAttribute& skin, std::size_t corner) {
  ASSERT_NE(skin.of_corner[corner], kNone);
  const JointWeights weights = weights_at(skin, corner);
  ASSERT_NEAR(sum_of(weights), 1, 1e-6);
  ASSERT_LE(weights.size(), skin.components / 2);
  for (const auto& [joint, weight] : weights) {
    ASSERT_GT(weight, 0);
    ASSERT_TRUE(joint >= 0 && joint < 300);
  }
}

// What the largest weights are at a place is the mean of those of the corners around.
void expect_mean(const CornerAttribute& given, std::size_t source,
                 const std::array<double, 3>& shares, const JointWeights& made) {
  JointWeights mean;
  for (std::size_t k = 0; k < 3; ++k) {
    for (const auto& [joint, weight] : weights_at(given, 3 * source + k)) {
      mean[joint] += shares[k] * weight;
    }
  }
  double kept = 0, least = 1, left_out = 0;
  for (const auto& [joint, weight] : made) kept += mean[joint];
  for (const auto& [joint, weight] : mean) {
    if (made.contains(joint)) {
      least = std::min(least, weight);
      EXPECT_NEAR(made.at(joint), weight / kept, 1e-4);
    } else {
      left_out = std::max(left_out, weight);
    }
  }
  EXPECT_LE(left_out, least + 1e-4);
}

TEST(SkinAttributes, WeightsOfNewCornersAddUpToOne) {
  std::size_t mixed = 0, patches = 0;
  for_each_seed(1, 50, [&](std::uint64_t seed) {
    std::mt19937 random(static_cast<std::uint32_t>(seed));
    const TriangleSoup soup = random_scene(random);
    Attributes attributes;
    attributes.corners.push_back(random_target(soup, random));
    attributes.corners.push_back(random_skin(soup, 1 + seed % 2, random));
    RepairOptions options;
    keep_attributes(soup, attributes, options);
    RepairReport report;
    const Surface surface = repair(soup, options, report);
    ASSERT_TRUE(report.certify.passed());
    const Attributes result = transfer_attributes(soup, attributes, surface);
    const CornerAttribute &skin = result.corners[1], &given = attributes.corners[1];
    for (std::size_t t = 0; t < surface.source.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        expect_sound(skin, 3 * t + k);
        if (::testing::Test::HasFatalFailure()) return;
        const std::uint32_t source = surface.source[t];
        if (source == Surface::kNoSource) {
          ++patches;
          continue;
        }
        const Vec3d& at = surface.mesh.points[surface.mesh.triangles[t][k]];
        const auto from = shares(at, corners_of(soup, source));
        if (!from || skin.of_corner[3 * t + k] < given.count()) continue;
        ++mixed;
        expect_mean(given, source, *from, weights_at(skin, 3 * t + k));
      }
    }
  });
  EXPECT_GT(mixed, 100u);
  EXPECT_GT(patches, 10u);
}

TEST(SkinAttributes, DifferencesOfNormalsTurnWithTheirTriangles) {
  TriangleSoup soup = sphere(100);
  std::swap(soup.triangles[3][1], soup.triangles[3][2]);
  std::mt19937 random(1);
  Attributes attributes;
  attributes.corners.push_back(random_target(soup, random));
  RepairOptions options;
  keep_attributes(soup, attributes, options);
  RepairReport report;
  const Surface surface = repair(soup, options, report);
  const Attributes result = transfer_attributes(soup, attributes, surface);
  for (std::size_t t = 0; t < surface.source.size(); ++t) {
    const double sign = surface.source[t] == 3 ? -1 : 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t p = surface.mesh.triangles[t][k];
      const auto same = std::find(soup.points.begin(), soup.points.end(), surface.mesh.points[p]);
      const auto from = static_cast<std::size_t>(same - soup.points.begin());
      const std::uint32_t value = result.corners[0].of_corner[3 * t + k];
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(result.corners[0].values[3 * value + i],
                    sign * attributes.corners[0].values[3 * from + i], 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace meshrepair
