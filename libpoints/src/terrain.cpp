// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <base/roots.h>
#include <mesh/edge_table.h>
#include <points/terrain.h>

namespace meshrepair {
namespace {

// Between the lowest and the highest hundredth of the points, as a share of the diagonal of the
// bounding box seen along the axis. Mountains have up to a quarter.
constexpr double kLeastRelief = 0.01;
constexpr double kMostRelief = 0.3;
constexpr double kStrayShare = 0.01;

// The mean of the cosine of the slope along the rims: 45 degrees. Where a scan of one side of a
// body ends, its slope is 60 degrees or more.
constexpr double kLeastRimCosine = 0.7;

// What all triangles cover seen along the axis, as a multiple of the area of the squares that hold
// a point. A sheet comes to 0.8 to 1, two on each other to twice that.
constexpr double kMostCover = 1.4;
constexpr double kSquareSpacings = 2;  // the side of a square

// A soup, seen along an axis.
class ViewFromAbove {
 public:
  ViewFromAbove(const TriangleSoup& soup, int axis)
      : soup_(soup), up_(axis), across_((axis + 1) % 3), along_((axis + 2) % 3) {
    for (const auto& triangle : soup.triangles) {
      for (const std::uint32_t p : triangle) used_.push_back(p);
    }
    std::sort(used_.begin(), used_.end());
    used_.erase(std::unique(used_.begin(), used_.end()), used_.end());
  }

  [[nodiscard]] double relief() const { return extent(up_, kStrayShare); }
  [[nodiscard]] double width() const { return hypotenuse(extent(across_, 0), extent(along_, 0)); }

  // The mean along all rims.
  [[nodiscard]] double rim_cosine() const {
    double sum = 0;
    double total = 0;
    EdgeTable(soup_.triangles).for_each_edge([&](std::span<const std::uint32_t> sides) {
      if (sides.size() != 1) return;
      const Vec3d& from = soup_.points[side_start(soup_.triangles, sides[0])];
      const Vec3d& to = soup_.points[side_start(soup_.triangles, next_side(sides[0]))];
      const Vec3d normal = twice_area(sides[0] / 3);
      const double length = (to - from).norm();
      if (!(normal.norm() > 0)) return;
      sum += length * std::abs(normal[up_]) / normal.norm();
      total += length;
    });
    return total > 0 ? sum / total : 0;
  }

  [[nodiscard]] double cover() const {
    double area = 0;
    for (std::size_t t = 0; t < soup_.triangles.size(); ++t) {
      area += std::abs(twice_area(t)[up_]) / 2;
    }
    const double side = kSquareSpacings * std::sqrt(area / static_cast<double>(used_.size()));
    if (!(side > 0)) return 0;
    std::vector<std::pair<double, double>> squares;
    squares.reserve(used_.size());
    for (const std::uint32_t p : used_) {
      const Vec3d& at = soup_.points[p];
      squares.emplace_back(std::floor(at[across_] / side), std::floor(at[along_] / side));
    }
    std::sort(squares.begin(), squares.end());
    const auto last = std::unique(squares.begin(), squares.end());
    return area / (side * side * static_cast<double>(last - squares.begin()));
  }

 private:
  // Of the points but for this share at either end.
  [[nodiscard]] double extent(int axis, double stray) const {
    if (used_.empty()) return 0;
    std::vector<double> places;
    places.reserve(used_.size());
    for (const std::uint32_t p : used_) places.push_back(soup_.points[p][axis]);
    std::sort(places.begin(), places.end());
    const auto out = static_cast<std::size_t>(stray * static_cast<double>(places.size()));
    return places[places.size() - 1 - out] - places[out];
  }

  [[nodiscard]] Vec3d twice_area(std::size_t triangle) const {
    const auto& [a, b, c] = soup_.triangles[triangle];
    const Vec3d& at = soup_.points[a];
    return (soup_.points[b] - at).cross(soup_.points[c] - at);
  }

  const TriangleSoup& soup_;
  int up_, across_, along_;
  std::vector<std::uint32_t> used_;
};

}  // namespace

bool is_terrain(const TriangleSoup& soup, int axis, double farthest_move) {
  const ViewFromAbove view(soup, axis);
  const double relief = view.relief();
  const double width = view.width();
  return width > 0 && relief >= std::max(kLeastRelief * width, farthest_move) &&
         relief <= kMostRelief * width && view.rim_cosine() >= kLeastRimCosine &&
         view.cover() <= kMostCover;
}

}  // namespace meshrepair
