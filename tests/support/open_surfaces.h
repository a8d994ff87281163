// SPDX-License-Identifier: MIT
// Surfaces that bound nothing, or have no two sides.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "shapes.h"

namespace meshrepair::testing {

inline TriangleSoup moebius_strip(std::uint32_t n) {
  TriangleSoup strip;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double a = 2 * std::numbers::pi * i / n;
    const Vec3d middle(3 * std::cos(a), 3 * std::sin(a), 0);
    const Vec3d across(std::cos(a / 2) * std::cos(a), std::cos(a / 2) * std::sin(a),
                       std::sin(a / 2));
    strip.points.push_back(middle - across);
    strip.points.push_back(middle + across);
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * i + 1;
    const bool last = i + 1 == n;
    const std::uint32_t c = last ? 1 : a + 2, d = last ? 0 : b + 2;
    strip.triangles.push_back({a, c, b});
    strip.triangles.push_back({b, c, d});
  }
  return strip;
}

// The figure-8 immersion: one-sided, without a border, and crossing itself.
inline TriangleSoup klein_bottle(std::uint32_t around, std::uint32_t across) {
  TriangleSoup bottle;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      const double a = 2 * std::numbers::pi * i / around;
      const double b = 2 * std::numbers::pi * j / across;
      const double out = 3 + std::cos(a / 2) * std::sin(b) - std::sin(a / 2) * std::sin(2 * b);
      bottle.points.emplace_back(out * std::cos(a), out * std::sin(a),
                                 std::sin(a / 2) * std::sin(b) + std::cos(a / 2) * std::sin(2 * b));
    }
  }
  // After one turn the ring comes back upside down.
  const auto at = [&](std::uint32_t i, std::uint32_t j) {
    return i < around ? i * across + j % across : (across - j % across) % across;
  };
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      bottle.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      bottle.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return bottle;
}

// Over [0, 4] x [0, 4], of n x n squares.
inline TriangleSoup wavy_sheet(std::uint32_t n) {
  TriangleSoup sheet;
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t j = 0; j <= n; ++j) {
      const double x = 4.0 * i / n, y = 4.0 * j / n;
      sheet.points.emplace_back(x, y, 0.3 * std::sin(2 * x) * std::cos(2 * y));
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
      sheet.triangles.push_back({a, b, b + 1});
      sheet.triangles.push_back({a, b + 1, a + 1});
    }
  }
  return sheet;
}

// Triangles around one edge, like the pages of an open book.
inline TriangleSoup pages(std::uint32_t count) {
  TriangleSoup book;
  book.points = {{0, 0, 0}, {1, 0, 0}};
  for (std::uint32_t i = 0; i < count; ++i) {
    const double a = std::numbers::pi * i / count;
    book.points.emplace_back(0.5, std::cos(a), std::sin(a));
    book.triangles.push_back({0, 1, i + 2});
  }
  return book;
}

struct OpenSurface {
  std::string name;
  TriangleSoup soup;
};

inline std::vector<OpenSurface> open_surfaces() {
  return {{"Moebius strip", moebius_strip(40)}, {"Klein bottle", klein_bottle(40, 24)},
          {"wavy sheet", wavy_sheet(16)},       {"one triangle", pages(1)},
          {"two triangles", pages(2)},          {"seven triangles", pages(7)}};
}

}  // namespace meshrepair::testing
