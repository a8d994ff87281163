// SPDX-License-Identifier: MIT
// Solids of revolution around the z axis.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <mesh/soup.h>

namespace meshrepair::testing {

// Distances from the axis, and heights.
using Profile = std::vector<std::array<double, 2>>;

// Points of an arc of a circle around the origin, from one angle to another, from the axis down.
inline Profile arc(double radius, double from, double to, std::size_t points) {
  Profile profile;
  for (std::size_t i = 0; i < points; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(points - 1);
    const double angle = from + share * (to - from);
    const bool is_pole = std::abs(std::sin(angle)) < 1e-12;
    profile.push_back({is_pole ? 0 : radius * std::sin(angle), radius * std::cos(angle)});
  }
  return profile;
}

// Between each point of the profile and the next; closed if that is, or begins and ends at the
// axis.
inline TriangleSoup revolved(const Profile& profile, std::uint32_t sides) {
  TriangleSoup soup;
  std::vector<std::vector<std::uint32_t>> rings;
  for (const auto& [radius, height] : profile) {
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    if (radius == 0) {
      soup.points.emplace_back(0, 0, height);
      rings.emplace_back(sides, first);
      continue;
    }
    rings.emplace_back();
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / sides;
      soup.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height);
      rings.back().push_back(first + i);
    }
  }
  for (std::size_t k = 0; k + 1 < rings.size(); ++k) {
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t j = (i + 1) % sides;
      const std::array<std::uint32_t, 4> c = {rings[k][i], rings[k][j], rings[k + 1][j],
                                              rings[k + 1][i]};
      if (c[0] != c[1]) soup.triangles.push_back({c[0], c[2], c[1]});
      if (c[2] != c[3]) soup.triangles.push_back({c[0], c[3], c[2]});
    }
  }
  return soup;
}

// A ball of radius 1 with a cavity, its wall so thick, and a hole of this radius through it on top.
inline TriangleSoup pierced_shell(double hole, double wall, std::uint32_t sides) {
  const double inner = 1 - wall;
  Profile profile = arc(1, std::asin(hole), std::numbers::pi, sides / 2);
  const Profile back = arc(inner, std::numbers::pi, std::asin(hole / inner), sides / 2);
  TriangleSoup soup = revolved(profile, sides);
  const auto last = static_cast<std::uint32_t>(soup.points.size());
  const TriangleSoup cavity = revolved(back, sides);
  soup.points.insert(soup.points.end(), cavity.points.begin(), cavity.points.end());
  for (const auto& t : cavity.triangles) {
    soup.triangles.push_back({last + t[0], last + t[1], last + t[2]});
  }
  const auto rim = static_cast<std::uint32_t>(soup.points.size()) - sides;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t j = (i + 1) % sides;
    soup.triangles.push_back({rim + i, j, rim + j});
    soup.triangles.push_back({rim + i, i, j});
  }
  return soup;
}

}  // namespace meshrepair::testing
