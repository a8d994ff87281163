// SPDX-License-Identifier: MIT
// Bytes to soups in the positions that break programs: small integers, so that coplanar, collinear
// and coincident is the rule, points a hair beside others, closed shapes, copies, turned triangles.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include <mesh/soup.h>

#include "fuzz_input.h"

namespace meshrepair::testing {

// A list of commands, each a byte and what it needs. Points and triangles are named by a byte,
// modulo how many there are.
class SoupDecoder {
 public:
  SoupDecoder(FuzzInput& input, std::size_t most_triangles)
      : input_(input), most_triangles_(most_triangles) {}

  TriangleSoup run() {
    while (!input_.empty() && soup_.triangles.size() < most_triangles_) command();
    soup_.triangles.resize(std::min(soup_.triangles.size(), most_triangles_));
    return std::move(soup_);
  }

 private:
  using Corners = std::array<std::uint32_t, 3>;

  void command() {
    switch (input_.below(12)) {
      case 0:
        return add_point(raw_point());
      case 1:
        return add_point(point_beside());
      case 2:
        return add_point(point_between());
      case 3:
        return add_box();
      case 4:
        return add_tetrahedron();
      case 5:
        return copy_triangle();
      case 6:
        return turn_triangle();
      case 7:
        return add_triangle_here();
      case 8:
        return add_point(small_point());
      default:
        return add_triangle();
    }
  }

  Vec3d small_point() {
    const auto coordinate = [&] { return static_cast<double>(input_.below(8)); };
    const double x = coordinate();
    const double y = coordinate();
    return {x, y, coordinate()};
  }

  // Any bits: sizes of all kinds, not numbers too.
  Vec3d raw_point() {
    const auto x = input_.number<double>();
    const auto y = input_.number<double>();
    return {x, y, input_.number<double>()};
  }

  // Some units in the last place, or 2^-k, away from another point along each axis.
  Vec3d point_beside() {
    Vec3d p = point(choose_point());
    const int exponent = -static_cast<int>(input_.below(50));
    for (double& x : p) {
      const int steps = static_cast<int>(input_.below(5)) - 2;
      if (exponent == 0) {
        for (int i = 0; i < std::abs(steps); ++i) x = std::nextafter(x, steps > 0 ? 99.0 : -99.0);
      } else {
        x += std::ldexp(steps, exponent);
      }
    }
    return p;
  }

  // On the line through two points, rounded.
  Vec3d point_between() {
    const Vec3d a = point(choose_point());
    const Vec3d b = point(choose_point());
    return a + (static_cast<double>(input_.below(16)) - 4) / 7 * (b - a);
  }

  void add_point(const Vec3d& p) { soup_.points.push_back(p); }

  std::uint32_t choose_point() {
    if (soup_.points.empty()) add_point({0, 0, 0});
    return static_cast<std::uint32_t>(input_.below(soup_.points.size()));
  }
  [[nodiscard]] const Vec3d& point(std::uint32_t index) const { return soup_.points[index]; }

  void add_triangle() {
    const std::uint32_t a = choose_point();
    const std::uint32_t b = choose_point();
    soup_.triangles.push_back({a, b, choose_point()});
  }

  // With points of its own.
  void add_triangle_here() {
    const auto first = static_cast<std::uint32_t>(soup_.points.size());
    for (int i = 0; i < 3; ++i) add_point(small_point());
    soup_.triangles.push_back({first, first + 1, first + 2});
  }

  void add_tetrahedron() {
    std::array<std::uint32_t, 4> p{};
    for (std::uint32_t& corner : p) corner = choose_point();
    for (const Corners& t : {Corners{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}) {
      soup_.triangles.push_back({p[t[0]], p[t[1]], p[t[2]]});
    }
  }

  // Along the axes, between two small points; flat if they share a coordinate.
  void add_box() {
    const Vec3d a = small_point();
    const Vec3d b = small_point();
    const auto first = static_cast<std::uint32_t>(soup_.points.size());
    for (unsigned corner = 0; corner < 8; ++corner) {
      Vec3d p = a.cwiseMin(b);
      for (unsigned axis = 0; axis < 3; ++axis) {
        if ((corner >> axis & 1) != 0) p[axis] = std::max(a[axis], b[axis]);
      }
      add_point(p);
    }
    constexpr std::array<std::array<std::uint32_t, 4>, 6> kSides = {
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    for (const auto& s : kSides) {
      soup_.triangles.push_back({first + s[0], first + s[1], first + s[2]});
      soup_.triangles.push_back({first + s[0], first + s[2], first + s[3]});
    }
  }

  Corners* choose_triangle() {
    if (soup_.triangles.empty()) return nullptr;
    return &soup_.triangles[input_.below(soup_.triangles.size())];
  }

  void turn_triangle() {
    if (Corners* t = choose_triangle()) std::swap((*t)[0], (*t)[1]);
  }

  void copy_triangle() {
    const Corners* t = choose_triangle();
    if (t == nullptr) return;
    Corners copy = *t;
    std::rotate(copy.begin(), copy.begin() + static_cast<int>(input_.below(3)), copy.end());
    soup_.triangles.push_back(copy);
  }

  FuzzInput& input_;
  std::size_t most_triangles_;
  TriangleSoup soup_;
};

}  // namespace meshrepair::testing
