// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <exact/region_volume.h>

namespace meshrepair {
namespace {

constexpr GridBox kBox = {{-8, -8, -8}, {8, 8, 8}};

Plane plane(std::int64_t x, std::int64_t y, std::int64_t z, std::int64_t offset) {
  return make_plane({x, y, z}, Int128{offset});
}

bool has_volume(const std::vector<Plane>& planes) { return RegionVolume(kBox).has_volume(planes); }

TEST(RegionVolume, PlanesAcrossAndBesideTheBoxAreTold) {
  EXPECT_TRUE(has_volume({}));
  EXPECT_TRUE(has_volume({plane(1, 0, 0, 0)}));
  EXPECT_TRUE(has_volume({plane(1, 2, 3, 40)}));
  EXPECT_FALSE(has_volume({plane(1, 0, 0, -9)}));
  EXPECT_FALSE(has_volume({plane(1, 1, 1, -25)}));
  EXPECT_TRUE(has_volume({plane(1, 1, 1, -23)}));
}

TEST(RegionVolume, FacetsEdgesAndPointsHaveNoVolume) {
  EXPECT_FALSE(has_volume({plane(1, 0, 0, -8)}));  // a face of the box
  EXPECT_FALSE(has_volume({plane(1, 1, 0, -16)}));
  EXPECT_FALSE(has_volume({plane(1, 1, 1, -24)}));
  EXPECT_FALSE(has_volume({plane(1, 2, 3, -4), plane(-1, -2, -3, 4)}));
  EXPECT_FALSE(has_volume({plane(1, 2, 3, -4), plane(-2, -4, -6, 8)}));
  EXPECT_TRUE(has_volume({plane(1, 2, 3, -4), plane(-1, -2, -3, 5)}));
  // Two wedges with one edge, and two cones with one tip.
  EXPECT_FALSE(has_volume({plane(1, 0, 0, 0), plane(0, 1, 0, 0), plane(-1, -1, 0, 0)}));
  EXPECT_FALSE(
      has_volume({plane(1, 0, 0, 0), plane(0, 1, 0, 0), plane(0, 0, 1, 0), plane(-1, -2, -3, 0)}));
  EXPECT_TRUE(
      has_volume({plane(1, 0, 0, 0), plane(0, 1, 0, 0), plane(0, 0, 1, 0), plane(-1, -2, 3, 0)}));
}

TEST(RegionVolume, CountsAPlaneThatIsThereTwiceOnce) {
  const Plane p = plane(3, -2, 5, 1);
  EXPECT_TRUE(has_volume({p, p, p}));
  EXPECT_FALSE(has_volume({p, turned(p)}));
}

// Another way: if a region has volume, it has one of the points in the middle of four corners that
// are not in one plane, among all points where three planes meet.
class ByCorners {
 public:
  explicit ByCorners(std::vector<Plane> planes) : planes_(std::move(planes)) {
    for (int axis = 0; axis < 3; ++axis) {
      std::array<std::int64_t, 3> n{};
      n[static_cast<std::size_t>(axis)] = 1;
      planes_.push_back(plane(n[0], n[1], n[2], 8));
      planes_.push_back(plane(-n[0], -n[1], -n[2], 8));
    }
  }

  // The mean of all corners of the closed region is strictly inside if anything is. Coefficients
  // are so small that doubles tell what is inside from what is on a wall.
  [[nodiscard]] bool has_volume() const {
    std::array<double, 3> sum{};
    double count = 0;
    for (std::size_t a = 0; a < planes_.size(); ++a) {
      for (std::size_t b = a + 1; b < planes_.size(); ++b) {
        for (std::size_t c = b + 1; c < planes_.size(); ++c) {
          std::array<double, 3> at{};
          if (!meet(planes_[a], planes_[b], planes_[c], at)) continue;
          if (least(at) < -1e-9) continue;
          for (std::size_t k = 0; k < 3; ++k) sum[k] += at[k];
          ++count;
        }
      }
    }
    if (count == 0) return false;
    return least({sum[0] / count, sum[1] / count, sum[2] / count}) > 1e-9;
  }

 private:
  static bool meet(const Plane& a, const Plane& b, const Plane& c, std::array<double, 3>& at) {
    const auto n = [](const Plane& p, std::size_t k) { return static_cast<double>(p.normal[k]); };
    const auto d = [](const Plane& p) { return static_cast<double>(p.offset); };
    const auto det = [&](auto column) {
      double value = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
        value += column(a, k) * (column(b, l) * column(c, m) - column(b, m) * column(c, l));
      }
      return value;
    };
    const double whole = det(n);
    if (whole == 0) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = -det([&](const Plane& p, std::size_t j) { return j == k ? d(p) : n(p, j); }) / whole;
    }
    return true;
  }

  [[nodiscard]] double least(const std::array<double, 3>& at) const {
    double value = 1e9;
    for (const Plane& p : planes_) {
      value = std::min(value, static_cast<double>(p.normal[0]) * at[0] +
                                  static_cast<double>(p.normal[1]) * at[1] +
                                  static_cast<double>(p.normal[2]) * at[2] +
                                  static_cast<double>(p.offset));
    }
    return value;
  }

  std::vector<Plane> planes_;
};

// Few directions and offsets, so that planes are often parallel, equal, or pass through one point.
TEST(RegionVolume, AgreesWithLookingAtAllCorners) {
  std::mt19937 random(7);
  RegionVolume region(kBox);
  std::size_t with_volume = 0;
  for (int round = 0; round < 4000; ++round) {
    std::vector<Plane> planes;
    const int spread = 1 + round % 3;
    std::uniform_int_distribution<int> component(-spread, spread);
    const std::size_t count = 1 + random() % 9;
    while (planes.size() < count) {
      const int x = component(random), y = component(random), z = component(random);
      if (x == 0 && y == 0 && z == 0) continue;
      planes.push_back(plane(x, y, z, component(random) - round % 2));
    }
    const bool expected = ByCorners(planes).has_volume();
    ASSERT_EQ(region.has_volume(planes), expected) << round;
    with_volume += expected;
  }
  EXPECT_GT(with_volume, 800u);
  EXPECT_LT(with_volume, 3200u);
  EXPECT_GT(region.decided_exactly(), 1000u);
}

}  // namespace
}  // namespace meshrepair
