// SPDX-License-Identifier: MIT
// Soups with the positions that break programs: coplanar, coincident, folded, nearly parallel,
// touching, thin. All coordinates are integers, all from a seed.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "random_geometry.h"
#include "shapes.h"

namespace meshrepair::testing {

inline void add_triangle(TriangleSoup& soup, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const auto base = static_cast<std::uint32_t>(soup.points.size());
  soup.points.insert(soup.points.end(), {a, b, c});
  soup.triangles.push_back({base, base + 1, base + 2});
}

inline Vec3d random_corner(Random& random, std::int32_t size) {
  return {static_cast<double>(random.integer(0, size)),
          static_cast<double>(random.integer(0, size)),
          static_cast<double>(random.integer(0, size))};
}

// Overlapping triangles in a few planes, some of them oblique.
inline TriangleSoup coplanar_soup(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  TriangleSoup soup;
  const std::array<std::array<Vec3d, 3>, 4> frames = {{{Vec3d(0, 0, 3), {1, 0, 0}, {0, 1, 0}},
                                                       {Vec3d(0, 0, 3), {1, 0, 0}, {0, 0, 1}},
                                                       {Vec3d(0, 1, 0), {1, 0, 1}, {0, 1, 2}},
                                                       {Vec3d(4, 4, 0), {1, -1, 0}, {0, 1, 1}}}};
  for (std::size_t i = 0; i < count; ++i) {
    const auto& frame = frames[static_cast<std::size_t>(random.integer(0, 3))];
    const auto corner = [&]() -> Vec3d {
      return frame[0] + random.integer(0, 8) * frame[1] + random.integer(0, 8) * frame[2];
    };
    const Vec3d a = corner();
    const Vec3d b = corner();
    add_triangle(soup, a, b, corner());
  }
  return soup;
}

// Pairs of triangles that share an edge and lie on each other, in part or wholly, in both
// orientations.
inline TriangleSoup folded_soup(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  TriangleSoup soup;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d a = random_corner(random, 6);
    const Vec3d b = a + 2 * random_corner(random, 3) - Vec3d::Constant(3);
    const Vec3d c = random_corner(random, 6);
    add_triangle(soup, a, b, c);
    // Back over itself: to the same point, to half way, or beyond.
    const double share = 0.5 * random.integer(1, 4);
    add_triangle(soup, b, a, Vec3d(a + share * (c - a)));
  }
  return soup;
}

// Large triangles whose planes are tilted against each other by one step in a million.
inline TriangleSoup nearly_parallel_soup(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  const std::int32_t size = 1000000;
  TriangleSoup soup;
  for (std::size_t i = 0; i < count; ++i) {
    const auto corner = [&] {
      return Vec3d(random.integer(0, size), random.integer(0, size), random.integer(-1, 1));
    };
    const Vec3d a = corner();
    const Vec3d b = corner();
    add_triangle(soup, a, b, corner());
  }
  add_triangle(soup, {0, 0, -size / 2.0}, {size * 1.0, 0, size / 2.0}, {0, size * 1.0, 0});
  return soup;
}

// Fans around a few common points.
inline TriangleSoup touching_soup(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  TriangleSoup soup;
  const std::array<Vec3d, 3> hubs = {Vec3d(5, 5, 5), Vec3d(0, 0, 0), Vec3d(5, 5, 0)};
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d a = random_corner(random, 10);
    add_triangle(soup, hubs[i % 3], a, random_corner(random, 10));
  }
  return soup;
}

// Needles: one grid step wide or less, and very long.
inline TriangleSoup sliver_soup(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  const std::int32_t size = 1 << 22;
  TriangleSoup soup;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d a = random_corner(random, size);
    const Vec3d b = random_corner(random, size);
    const Vec3d beside = b + random_corner(random, 2) - Vec3d::Constant(1);
    add_triangle(soup, a, b,
                 random.chance(0.5) ? beside : Vec3d((0.5 * (a + beside)).array().round()));
  }
  return soup;
}

// A tetrahedron from each of a few corner sets on a small grid: closed parts that share faces in
// part.
inline TriangleSoup tetrahedra_soup(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  TriangleSoup soup;
  while (count > 0) {
    std::array<Vec3d, 4> p;
    for (Vec3d& corner : p) corner = random_corner(random, 4);
    const double volume = (p[1] - p[0]).dot((p[2] - p[0]).cross(p[3] - p[0]));
    if (volume == 0) continue;
    if (volume < 0) std::swap(p[0], p[1]);
    add_triangle(soup, p[0], p[2], p[1]);
    add_triangle(soup, p[0], p[1], p[3]);
    add_triangle(soup, p[1], p[2], p[3]);
    add_triangle(soup, p[0], p[3], p[2]);
    --count;
  }
  return soup;
}

// Copies of the soup's triangles, some turned, some with their corners rotated.
inline TriangleSoup with_copies(TriangleSoup soup, double share, std::uint64_t seed) {
  Random random(seed);
  const std::size_t count = soup.triangles.size();
  for (std::size_t i = 0; i < count; ++i) {
    auto t = soup.triangles[i];
    if (!random.chance(share)) continue;
    if (random.chance(0.5)) std::swap(t[0], t[1]);
    std::rotate(t.begin(), t.begin() + random.integer(0, 2), t.end());
    soup.triangles.push_back(t);
  }
  return soup;
}

struct SoupFamily {
  std::string name;
  std::function<TriangleSoup(std::uint64_t seed)> make;
};

inline void PrintTo(const SoupFamily& family, std::ostream* out) { *out << family.name; }

inline const std::vector<SoupFamily>& degenerate_families() {
  static const std::vector<SoupFamily> families = {
      {"Coplanar", [](std::uint64_t s) { return coplanar_soup(20 + 10 * (s % 5), s); }},
      {"Coincident", [](std::uint64_t s) { return with_copies(random_soup(30, 3, s), 0.7, s); }},
      {"Folded", [](std::uint64_t s) { return folded_soup(10 + 5 * (s % 5), s); }},
      {"NearlyParallel", [](std::uint64_t s) { return nearly_parallel_soup(8 + s % 9, s); }},
      {"Touching", [](std::uint64_t s) { return touching_soup(20 + 8 * (s % 6), s); }},
      {"Sliver", [](std::uint64_t s) { return sliver_soup(12 + 4 * (s % 5), s); }},
      {"GridBoxes", [](std::uint64_t s) { return random_grid_boxes(3 + s % 15, 5, s); }},
      {"Tetrahedra", [](std::uint64_t s) { return tetrahedra_soup(4 + s % 16, s); }},
      {"SmallGrid", [](std::uint64_t s) { return random_soup(20 + 10 * (s % 6), 3, s); }},
      {"LargeGrid", [](std::uint64_t s) { return random_soup(20 + 5 * (s % 6), 1 << 24, s); }},
  };
  return families;
}

}  // namespace meshrepair::testing
