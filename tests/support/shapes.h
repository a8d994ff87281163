// SPDX-License-Identifier: MIT
// Shapes for tests and benchmarks: closed, counter-clockwise seen from outside, unless their name
// says otherwise. All deterministic.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include <mesh/soup.h>

#include "random_geometry.h"

namespace meshrepair::testing {

inline void append(TriangleSoup& soup, const TriangleSoup& other) {
  const auto base = static_cast<std::uint32_t>(soup.points.size());
  soup.points.insert(soup.points.end(), other.points.begin(), other.points.end());
  for (const auto& t : other.triangles) {
    soup.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  }
}

inline TriangleSoup together(TriangleSoup soup, const TriangleSoup& other) {
  append(soup, other);
  return soup;
}

inline TriangleSoup moved(TriangleSoup soup, const Vec3d& by) {
  for (Vec3d& p : soup.points) p += by;
  return soup;
}

inline TriangleSoup scaled(TriangleSoup soup, double by) {
  for (Vec3d& p : soup.points) p *= by;
  return soup;
}

inline TriangleSoup flipped(TriangleSoup soup) {
  for (auto& t : soup.triangles) std::swap(t[1], t[2]);
  return soup;
}

inline TriangleSoup transformed(TriangleSoup soup, const Eigen::Matrix3d& by) {
  for (Vec3d& p : soup.points) p = by * p;
  return soup;
}

// The box from `low` to `high`, 12 triangles.
inline TriangleSoup box(const Vec3d& low, const Vec3d& high) {
  TriangleSoup soup;
  for (int k = 0; k < 8; ++k) {
    soup.points.emplace_back((k & 1) != 0 ? high.x() : low.x(), (k & 2) != 0 ? high.y() : low.y(),
                             (k & 4) != 0 ? high.z() : low.z());
  }
  const std::array<std::array<std::uint32_t, 4>, 6> sides = {
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& s : sides) {
    soup.triangles.push_back({s[0], s[1], s[2]});
    soup.triangles.push_back({s[0], s[2], s[3]});
  }
  return soup;
}

inline TriangleSoup cube() { return box({0, 0, 0}, {1, 1, 1}); }

// A grid of quads over two angles, with poles; about `triangles` triangles.
inline TriangleSoup sphere(std::size_t triangles, double radius = 1,
                           const Vec3d& centre = {0, 0, 0}) {
  const auto rings = std::max<std::uint32_t>(
      3, static_cast<std::uint32_t>(std::sqrt(static_cast<double>(triangles) / 4)) + 1);
  const std::uint32_t columns = 2 * (rings - 1);
  TriangleSoup soup;
  soup.points.push_back(centre + Vec3d(0, 0, radius));
  for (std::uint32_t r = 1; r < rings; ++r) {
    const double a = std::numbers::pi * r / rings;
    for (std::uint32_t c = 0; c < columns; ++c) {
      const double b = 2 * std::numbers::pi * c / columns;
      soup.points.push_back(centre + radius * Vec3d(std::sin(a) * std::cos(b),
                                                    std::sin(a) * std::sin(b), std::cos(a)));
    }
  }
  soup.points.push_back(centre - Vec3d(0, 0, radius));
  const auto last = static_cast<std::uint32_t>(soup.points.size() - 1);
  const auto at = [&](std::uint32_t r, std::uint32_t c) {
    return 1 + (r - 1) * columns + c % columns;
  };
  for (std::uint32_t c = 0; c < columns; ++c) {
    soup.triangles.push_back({0, at(1, c), at(1, c + 1)});
    for (std::uint32_t r = 1; r + 1 < rings; ++r) {
      soup.triangles.push_back({at(r, c), at(r + 1, c), at(r + 1, c + 1)});
      soup.triangles.push_back({at(r, c), at(r + 1, c + 1), at(r, c + 1)});
    }
    soup.triangles.push_back({at(rings - 1, c), last, at(rings - 1, c + 1)});
  }
  return soup;
}

// A cone of height 1 on a disk of radius 1, the disk a fan from one point of its rim.
inline TriangleSoup cone(std::uint32_t sides) {
  TriangleSoup soup;
  soup.points.emplace_back(0, 0, 1);
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    soup.points.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  for (std::uint32_t i = 0; i < sides; ++i) {
    soup.triangles.push_back({0, 1 + i, 1 + (i + 1) % sides});
  }
  for (std::uint32_t i = 1; i + 1 < sides; ++i) soup.triangles.push_back({1, 2 + i, 1 + i});
  return soup;
}

inline TriangleSoup torus(std::uint32_t around, std::uint32_t across, double large = 2,
                          double small = 0.7) {
  TriangleSoup soup;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      const double a = 2 * std::numbers::pi * i / around;
      const double b = 2 * std::numbers::pi * j / across;
      const double r = large + small * std::cos(b);
      soup.points.emplace_back(r * std::cos(a), r * std::sin(a), small * std::sin(b));
    }
  }
  const auto at = [&](std::uint32_t i, std::uint32_t j) {
    return (i % around) * across + j % across;
  };
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      soup.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      soup.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return soup;
}

inline TriangleSoup two_overlapping_spheres(std::size_t triangles) {
  TriangleSoup soup = sphere(triangles / 2, 1, {0, 0, 0});
  append(soup, sphere(triangles / 2, 1, {0.7, 0.31, 0.17}));
  return soup;
}

inline Eigen::Matrix3d random_rotation(Random& random) {
  Eigen::Quaterniond q(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1),
                       random.real(-1, 1));
  return q.normalized().toRotationMatrix();
}

// Turned about, and moved away from the origin.
inline TriangleSoup placed(const TriangleSoup& soup, std::uint64_t seed) {
  Random random(seed);
  const Eigen::Matrix3d turn = random_rotation(random);
  const Vec3d by(random.real(-9, 9), random.real(-9, 9), random.real(-9, 9));
  return moved(transformed(soup, turn), by);
}

// Turned cubes with centres in a unit cube. Their edges shrink with their number, so that each
// overlaps a few others however many there are.
inline TriangleSoup random_cubes(std::size_t count, std::uint64_t seed) {
  const double edge = 0.45 / std::cbrt(static_cast<double>(count));
  Random random(seed);
  TriangleSoup soup;
  for (std::size_t i = 0; i < count; ++i) {
    const double half = 0.5 * edge * random.real(0.7, 1.3);
    const Vec3d centre(random.real(0, 1), random.real(0, 1), random.real(0, 1));
    append(soup, moved(transformed(box(Vec3d::Constant(-half), Vec3d::Constant(half)),
                                   random_rotation(random)),
                       centre));
  }
  return soup;
}

// Boxes with integer corners in [0, size]^3: common planes, edges and corners abound.
inline TriangleSoup random_grid_boxes(std::size_t count, std::int32_t size, std::uint64_t seed) {
  Random random(seed);
  TriangleSoup soup;
  for (std::size_t i = 0; i < count; ++i) {
    Vec3d low, high;
    for (int axis = 0; axis < 3; ++axis) {
      const std::int32_t a = random.integer(0, size - 1);
      low[axis] = a;
      high[axis] = random.integer(a + 1, size);
    }
    append(soup, box(low, high));
  }
  return soup;
}

// A sphere whose points are moved at random, so that it crosses itself.
inline TriangleSoup noisy_sphere(std::size_t triangles, double noise, std::uint64_t seed) {
  Random random(seed);
  TriangleSoup soup = sphere(triangles);
  for (Vec3d& p : soup.points) {
    p += Vec3d(random.real(-noise, noise), random.real(-noise, noise), random.real(-noise, noise));
  }
  return soup;
}

// Triangles with corners on a small integer grid: coplanar, coincident, touching, crossing.
inline TriangleSoup random_soup(std::size_t count, std::int32_t size, std::uint64_t seed) {
  Random random(seed);
  TriangleSoup soup;
  for (std::size_t i = 0; i < count; ++i) {
    const auto base = static_cast<std::uint32_t>(soup.points.size());
    for (int k = 0; k < 3; ++k) {
      soup.points.emplace_back(random.integer(0, size), random.integer(0, size),
                               random.integer(0, size));
    }
    soup.triangles.push_back({base, base + 1, base + 2});
  }
  return soup;
}

inline TriangleSoup without_some(const TriangleSoup& soup, double share, std::uint64_t seed) {
  Random random(seed);
  TriangleSoup kept;
  kept.points = soup.points;
  for (const auto& t : soup.triangles) {
    if (!random.chance(share)) kept.triangles.push_back(t);
  }
  return kept;
}

inline TriangleSoup with_some_flipped(TriangleSoup soup, double share, std::uint64_t seed) {
  Random random(seed);
  for (auto& t : soup.triangles) {
    if (random.chance(share)) std::swap(t[1], t[2]);
  }
  return soup;
}

}  // namespace meshrepair::testing
