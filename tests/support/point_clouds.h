// SPDX-License-Identifier: MIT
// Samples of closed surfaces, for tests and benchmarks. All from a seed.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <unordered_map>
#include <vector>

#include <Eigen/Geometry>

#include <mesh/point_cloud.h>
#include <mesh/soup.h>
#include <mesh/topology.h>

#include "random_geometry.h"

namespace meshrepair::testing {

// The distance at which points lie that share the area evenly.
inline double spacing_of(const TriangleSoup& surface, std::size_t points) {
  return std::sqrt(surface_area(surface) / static_cast<double>(points));
}

// Draws points evenly by area, independently of each other.
class SurfaceSampler {
 public:
  SurfaceSampler(const TriangleSoup& surface, std::uint64_t seed) : soup_(surface), random_(seed) {
    double sum = 0;
    for (const auto& t : soup_.triangles) {
      const Vec3d& a = soup_.points[t[0]];
      sum += (soup_.points[t[1]] - a).cross(soup_.points[t[2]] - a).norm();
      areas_.push_back(sum);
    }
  }

  Vec3d draw() {
    const double at = random_.real(0, areas_.back());
    const auto found = std::upper_bound(areas_.begin(), areas_.end(), at) - areas_.begin();
    const auto& t = soup_.triangles[std::min(static_cast<std::size_t>(found), areas_.size() - 1)];
    double u = random_.real(0, 1);
    double v = random_.real(0, 1);
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const Vec3d& a = soup_.points[t[0]];
    return a + u * (soup_.points[t[1]] - a) + v * (soup_.points[t[2]] - a);
  }

 private:
  const TriangleSoup& soup_;
  Random random_;
  std::vector<double> areas_;
};

inline PointCloud sampled_at_random(const TriangleSoup& surface, std::size_t points,
                                    std::uint64_t seed) {
  SurfaceSampler sampler(surface, seed);
  PointCloud cloud;
  for (std::size_t i = 0; i < points; ++i) cloud.points.push_back(sampler.draw());
  return cloud;
}

// Like blue noise: no two points are nearer than three quarters of the spacing.
inline PointCloud sampled_evenly(const TriangleSoup& surface, std::size_t points,
                                 std::uint64_t seed) {
  constexpr double kNearest = 0.75;
  const double apart = kNearest * spacing_of(surface, points);
  const auto cell_of = [&](double x) { return static_cast<std::int64_t>(std::floor(x / apart)); };
  const auto key_of = [](std::int64_t x, std::int64_t y, std::int64_t z) {
    return (x * 73856093) ^ (y * 19349663) ^ (z * 83492791);
  };
  std::unordered_multimap<std::int64_t, std::uint32_t> cells;
  SurfaceSampler sampler(surface, seed);
  PointCloud cloud;
  const auto is_free = [&](const Vec3d& p) {
    for (std::int64_t k = 0; k < 27; ++k) {
      const auto [first, last] = cells.equal_range(key_of(
          cell_of(p.x()) + k % 3 - 1, cell_of(p.y()) + k / 3 % 3 - 1, cell_of(p.z()) + k / 9 - 1));
      for (auto it = first; it != last; ++it) {
        if ((cloud.points[it->second] - p).norm() < apart) return false;
      }
    }
    return true;
  };
  // Beyond so many throws the surface is taken to be full.
  for (std::size_t i = 0; i < 200 * points && cloud.points.size() < points; ++i) {
    const Vec3d p = sampler.draw();
    if (!is_free(p)) continue;
    cells.emplace(key_of(cell_of(p.x()), cell_of(p.y()), cell_of(p.z())),
                  static_cast<std::uint32_t>(cloud.points.size()));
    cloud.points.push_back(p);
  }
  return cloud;
}

// Each coordinate moved by a sum of twelve random numbers, nearly normally distributed.
inline PointCloud with_noise(PointCloud cloud, double deviation, std::uint64_t seed) {
  Random random(seed);
  for (Vec3d& p : cloud.points) {
    for (int axis = 0; axis < 3; ++axis) {
      double sum = -6;
      for (int i = 0; i < 12; ++i) sum += random.real(0, 1);
      p[axis] += deviation * sum;
    }
  }
  return cloud;
}

// The boundary of the unit cubes of a grid of this size that `solid` says are there.
inline TriangleSoup cubes_boundary(const std::array<int, 3>& size,
                                   const std::function<bool(int, int, int)>& solid) {
  TriangleSoup soup;
  std::map<std::array<int, 3>, std::uint32_t> numbers;
  const auto number = [&](const std::array<int, 3>& at) {
    const auto [entry, added] =
        numbers.try_emplace(at, static_cast<std::uint32_t>(soup.points.size()));
    if (added) soup.points.emplace_back(at[0], at[1], at[2]);
    return entry->second;
  };
  const auto is_solid = [&](const std::array<int, 3>& c) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (c[k] < 0 || c[k] >= size[k]) return false;
    }
    return solid(c[0], c[1], c[2]);
  };
  const auto add_side = [&](std::array<int, 3> corner, std::size_t axis, bool outward) {
    corner[axis] += outward ? 1 : 0;
    std::array<std::uint32_t, 4> quad = {};
    for (std::size_t k = 0; k < 4; ++k) {
      std::array<int, 3> at = corner;
      at[(axis + 1) % 3] += k == 1 || k == 2 ? 1 : 0;
      at[(axis + 2) % 3] += k >= 2 ? 1 : 0;
      quad[k] = number(at);
    }
    if (!outward) std::swap(quad[1], quad[3]);
    soup.triangles.push_back({quad[0], quad[1], quad[2]});
    soup.triangles.push_back({quad[0], quad[2], quad[3]});
  };
  for (int x = 0; x < size[0]; ++x) {
    for (int y = 0; y < size[1]; ++y) {
      for (int z = 0; z < size[2]; ++z) {
        if (!is_solid({x, y, z})) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          std::array<int, 3> other = {x, y, z};
          ++other[axis];
          if (!is_solid(other)) add_side({x, y, z}, axis, true);
          other[axis] -= 2;
          if (!is_solid(other)) add_side({x, y, z}, axis, false);
        }
      }
    }
  }
  return soup;
}

// A ladder with five openings.
inline TriangleSoup genus_five_body() {
  return cubes_boundary({11, 3, 1}, [](int x, int y, int) { return y != 1 || x % 2 == 0; });
}

// The number of handles of a closed manifold, all parts together.
inline std::int64_t genus_of(const Topology& surface, std::size_t points) {
  const auto euler = static_cast<std::int64_t>(points) - static_cast<std::int64_t>(surface.edges) +
                     static_cast<std::int64_t>(surface.triangles);
  return static_cast<std::int64_t>(surface.parts) - euler / 2;
}

}  // namespace meshrepair::testing
