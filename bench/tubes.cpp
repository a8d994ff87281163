// SPDX-License-Identifier: MIT
#include "tubes.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include <Eigen/Geometry>

namespace meshrepair::bench {
namespace {

// The lattice as boxes of two widths by turns: those with two even numbers or more are full.
class Lattice {
 public:
  Lattice(std::uint32_t size, double thickness)
      : boxes_(static_cast<int>(2 * size + 1)), thickness_(thickness) {}

  TriangleSoup surface() {
    for (int x = 0; x < boxes_; ++x) {
      for (int y = 0; y < boxes_; ++y) {
        for (int z = 0; z < boxes_; ++z) add_sides({x, y, z});
      }
    }
    return std::move(soup_);
  }

 private:
  using Place = std::array<int, 3>;

  [[nodiscard]] bool full(const Place& at) const {
    int even = 0;
    for (const int i : at) {
      if (i < 0 || i >= boxes_) return false;
      even += i % 2 == 0;
    }
    return even >= 2;
  }

  void add_sides(const Place& at) {
    if (!full(at)) return;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int way : {-1, 1}) {
        Place beyond = at;
        beyond[axis] += way;
        if (!full(beyond)) add_side(at, axis, way > 0);
      }
    }
  }

  void add_side(const Place& at, std::size_t axis, bool far) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::array<std::uint32_t, 4> corners{};
    for (std::uint32_t k = 0; k < 4; ++k) {
      Place corner = at;
      corner[axis] += far ? 1 : 0;
      corner[u] += k == 1 || k == 2 ? 1 : 0;
      corner[v] += k >= 2 ? 1 : 0;
      corners[k] = point(corner);
    }
    const auto [a, b, c, d] = corners;
    if (far) {
      soup_.triangles.push_back({a, b, c});
      soup_.triangles.push_back({a, c, d});
    } else {
      soup_.triangles.push_back({a, c, b});
      soup_.triangles.push_back({a, d, c});
    }
  }

  std::uint32_t point(const Place& corner) {
    const auto [entry, added] =
        points_.emplace(corner, static_cast<std::uint32_t>(soup_.points.size()));
    if (added)
      soup_.points.emplace_back(coordinate(corner[0]), coordinate(corner[1]),
                                coordinate(corner[2]));
    return entry->second;
  }

  [[nodiscard]] double coordinate(int i) const {
    const int joint = i / 2;
    return joint + (i % 2 == 0 ? -0.5 : 0.5) * thickness_;
  }

  int boxes_;
  double thickness_;
  std::map<Place, std::uint32_t> points_;
  TriangleSoup soup_;
};

}  // namespace

TriangleSoup tube(const std::vector<Vec3d>& line, double radius, std::uint32_t sides) {
  TriangleSoup soup;
  Vec3d across = (line[1] - line[0]).unitOrthogonal();
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec3d before = i > 0 ? (line[i] - line[i - 1]).normalized() : Vec3d::Zero();
    const Vec3d behind = i + 1 < line.size() ? (line[i + 1] - line[i]).normalized() : Vec3d::Zero();
    const Vec3d along = (before + behind).normalized();
    across = (across - along.dot(across) * along).normalized();
    const Vec3d third = along.cross(across);
    for (std::uint32_t k = 0; k < sides; ++k) {
      const double angle = 2 * std::numbers::pi * k / sides;
      soup.points.push_back(line[i] +
                            radius * (std::cos(angle) * across + std::sin(angle) * third));
    }
  }
  const auto rings = static_cast<std::uint32_t>(line.size());
  const auto at = [&](std::uint32_t ring, std::uint32_t k) { return ring * sides + k % sides; };
  for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
    for (std::uint32_t k = 0; k < sides; ++k) {
      soup.triangles.push_back({at(ring, k), at(ring, k + 1), at(ring + 1, k + 1)});
      soup.triangles.push_back({at(ring, k), at(ring + 1, k + 1), at(ring + 1, k)});
    }
  }
  for (std::uint32_t k = 1; k + 1 < sides; ++k) {
    soup.triangles.push_back({at(0, 0), at(0, k + 1), at(0, k)});
    soup.triangles.push_back({at(rings - 1, 0), at(rings - 1, k), at(rings - 1, k + 1)});
  }
  return soup;
}

TriangleSoup lattice_truss(std::uint32_t size, double thickness) {
  return Lattice(size, thickness).surface();
}

}  // namespace meshrepair::bench
