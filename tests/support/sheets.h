// SPDX-License-Identifier: MIT
// Random open sheets, and measures of what became of them as walls.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <mesh/edge_table.h>
#include <mesh/topology.h>

#include "open_surfaces.h"
#include "random_geometry.h"
#include "shapes.h"

namespace meshrepair::testing {

// Over the unit square, of n x m squares cut along either diagonal.
inline TriangleSoup sheet_of(std::uint32_t n, std::uint32_t m,
                             const std::function<Vec3d(double, double)>& place) {
  TriangleSoup sheet;
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t j = 0; j <= m; ++j) {
      sheet.points.push_back(place(static_cast<double>(i) / n, static_cast<double>(j) / m));
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < m; ++j) {
      const std::uint32_t a = i * (m + 1) + j, b = a + 1, c = a + m + 1, d = c + 1;
      if ((i + j) % 2 == 0) {
        sheet.triangles.insert(sheet.triangles.end(), {{a, c, b}, {c, d, b}});
      } else {
        sheet.triangles.insert(sheet.triangles.end(), {{a, c, d}, {a, d, b}});
      }
    }
  }
  return sheet;
}

inline TriangleSoup flat_sheet(Random& random) {
  const double wide = random.real(0.3, 1);
  return sheet_of(static_cast<std::uint32_t>(random.integer(1, 4)),
                  static_cast<std::uint32_t>(random.integer(1, 4)),
                  [&](double u, double v) { return Vec3d(u, v * wide, 0); });
}

inline TriangleSoup curved_sheet(Random& random) {
  const auto n = static_cast<std::uint32_t>(random.integer(8, 14));
  if (random.chance(0.5)) {
    const double high = random.real(0.02, 0.08), waves = random.real(2, 5);
    return sheet_of(n, n, [&](double u, double v) {
      return Vec3d(u, v, high * std::sin(waves * u) * std::cos(waves * v));
    });
  }
  const double turn = random.real(0.5, 4), length = random.real(0.5, 2);
  return sheet_of(2 * n, 3, [&](double u, double v) {
    return Vec3d(0.5 * std::cos(turn * u), 0.5 * std::sin(turn * u), length * v);
  });
}

// Up and down, or once.
inline TriangleSoup folded_sheet(Random& random) {
  const double steep = random.real(0.2, 1.3);
  const auto folds = static_cast<std::uint32_t>(random.integer(2, 4));
  const double lean = random.real(0, 0.3);
  return sheet_of(folds, static_cast<std::uint32_t>(random.integer(1, 3)), [&](double u, double v) {
    const double along = u * folds;
    const auto step = static_cast<std::uint32_t>(std::lround(along));
    return Vec3d(along * std::cos(steep), v + lean * along, step % 2 == 0 ? 0 : std::sin(steep));
  });
}

// A tip with an open base: several folds meet in a point.
inline TriangleSoup tip_sheet(Random& random) {
  const auto sides = static_cast<std::uint32_t>(random.integer(3, 9));
  const double high = random.real(0.1, 0.9);
  TriangleSoup tip;
  tip.points.emplace_back(0, 0, high);
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double a = 2 * std::numbers::pi * i / sides;
    tip.points.emplace_back(std::cos(a), std::sin(a), 0);
    tip.triangles.push_back({0, 1 + i, 1 + (i + 1) % sides});
  }
  return tip;
}

inline TriangleSoup turned(const TriangleSoup& soup, Random& random) {
  return transformed(soup, random_rotation(random));
}

// How far it is to a sheet, and to its rim.
struct NearestPlace {
  double distance = 1e300;
  double rim = 1e300;
};

class SheetDistance {
 public:
  explicit SheetDistance(const TriangleSoup& sheet) : sheet_(sheet) {
    EdgeTable(sheet.triangles).for_each_edge([&](std::span<const std::uint32_t> sides) {
      if (sides.size() == 1) rims_.push_back(sides[0]);
    });
  }

  [[nodiscard]] NearestPlace operator()(const Vec3d& p) const {
    NearestPlace nearest;
    for (const auto& [a, b, c] : sheet_.triangles) {
      nearest.distance = std::min(
          nearest.distance, to_triangle(p, sheet_.points[a], sheet_.points[b], sheet_.points[c]));
    }
    for (const std::uint32_t side : rims_) {
      const Vec3d& a = sheet_.points[side_start(sheet_.triangles, side)];
      const Vec3d& b = sheet_.points[side_start(sheet_.triangles, next_side(side))];
      nearest.rim = std::min(nearest.rim, to_segment(p, a, b));
    }
    return nearest;
  }

 private:
  static double to_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
    const double along = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (p - a - along * (b - a)).norm();
  }

  static double to_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const Vec3d normal = (b - a).cross(c - a).normalized();
    const Vec3d q = p - (p - a).dot(normal) * normal;
    const auto is_left = [&](const Vec3d& from, const Vec3d& to) {
      return (to - from).cross(q - from).dot(normal) >= 0;
    };
    if (is_left(a, b) && is_left(b, c) && is_left(c, a)) return (p - q).norm();
    return std::min({to_segment(p, a, b), to_segment(p, b, c), to_segment(p, c, a)});
  }

  const TriangleSoup& sheet_;
  std::vector<std::uint32_t> rims_;  // sides
};

// A place in a triangle, any as likely as the others.
inline Vec3d random_place(const TriangleSoup& soup, std::size_t t, Random& random) {
  const auto& [a, b, c] = soup.triangles[t];
  double u = random.real(0, 1), v = random.real(0, 1);
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  const auto& at = soup.points;
  return at[a] + u * (at[b] - at[a]) + v * (at[c] - at[a]);
}

}  // namespace meshrepair::testing
