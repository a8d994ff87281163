// SPDX-License-Identifier: MIT
// Surfaces with attributes, compared with the soup that they were made of.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <extract/surface.h>

#include "textured.h"

namespace meshrepair::testing {

struct TexturedSurface {
  Surface surface;
  Attributes attributes;
};

inline std::array<Vec3d, 3> corners_of(const TriangleSoup& soup, std::size_t t) {
  const auto& c = soup.triangles[t];
  return {soup.points[c[0]], soup.points[c[1]], soup.points[c[2]]};
}

// Of the point of the triangle's plane that is nearest to a point that may be moved from there, as
// simplification does; nothing of one that is farther from the triangle.
inline std::optional<std::array<double, 3>> shares(const Vec3d& p, const std::array<Vec3d, 3>& t) {
  constexpr double kMoved = 2e-6;
  const Vec3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double area = normal.norm();
  if (std::abs(normal.dot(p - t[0])) > kMoved * area) return std::nullopt;
  std::array<double, 3> result;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d &a = t[(k + 1) % 3], &b = t[(k + 2) % 3];
    result[k] = (a - p).cross(b - p).dot(normal) / (area * area);
    if (result[k] * area < -kMoved * (b - a).norm()) return std::nullopt;
  }
  return result;
}

inline std::vector<double> value_at(const CornerAttribute& attribute, std::size_t t,
                                    const std::array<double, 3>& share) {
  std::vector<double> value(attribute.components, 0);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t v = attribute.of_corner[3 * t + k];
    EXPECT_NE(v, kNone);
    for (std::size_t i = 0; i < attribute.components; ++i) {
      value[i] += share[k] * attribute.values[attribute.components * v + i];
    }
  }
  return value;
}

// Of as many numbers as both have.
inline double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

// How far values may be off. Single precision of numbers from 0 to 1 is 6e-8, and so is that of
// places.
struct ValueBounds {
  double texture = 1e-6;
  double colour = 1e-6;

  [[nodiscard]] double of(CornerAttribute::Kind kind) const {
    return kind == CornerAttribute::Kind::colour ? colour : texture;
  }
};

// Of random points of the result: how far its values are from those that the input has there, in a
// triangle of the same material. Normals are not compared: they are made 1 long.
inline void expect_same_on_surface(const TexturedSoup& input, const TexturedSurface& result,
                                   int points, const ValueBounds& bounds = {}) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  const TriangleSoup& mesh = result.surface.mesh;
  const auto names = names_of(result.attributes.materials);
  const auto given_names = names_of(input.attributes.materials);
  for (int i = 0; i < points; ++i) {
    const std::size_t t = random() % mesh.triangles.size();
    std::array<double, 3> share = {unit(random), unit(random), 0};
    if (share[0] + share[1] > 1) share = {1 - share[0], 1 - share[1], 0};
    share[2] = 1 - share[0] - share[1];
    const auto corners = corners_of(mesh, t);
    const Vec3d at = share[0] * corners[0] + share[1] * corners[1] + share[2] * corners[2];
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t s = 0; s < input.soup.triangles.size(); ++s) {
      const auto there = shares(at, corners_of(input.soup, s));
      if (!there || given_names[s] != names[t]) continue;
      double worst = 0;  // as a share of what is allowed
      for (const CornerAttribute& attribute : input.attributes.corners) {
        if (attribute.kind == CornerAttribute::Kind::normal) continue;
        const CornerAttribute* const made = find_kind(result.attributes, attribute.kind);
        ASSERT_NE(made, nullptr);
        worst =
            std::max(worst, difference(value_at(attribute, s, *there), value_at(*made, t, share)) /
                                bounds.of(attribute.kind));
      }
      best = std::min(best, worst);
    }
    ASSERT_LT(best, 1) << "triangle " << t;
  }
}

// Whatever has the corners of a triangle of the input has its values.
inline void expect_whole_triangles_bit_for_bit(const TexturedSoup& input,
                                               const TexturedSurface& result) {
  std::size_t whole = 0;
  for (std::size_t a = 0; a < input.attributes.corners.size(); ++a) {
    const auto given = value_bits(input.attributes.corners[a]);
    const auto made = value_bits(result.attributes.corners[a]);
    for (std::size_t t = 0; t < result.surface.source.size(); ++t) {
      const std::uint32_t s = result.surface.source[t];
      if (s == Surface::kNoSource) continue;
      const auto from = corners_of(input.soup, s), to = corners_of(result.surface.mesh, t);
      if (from != to) continue;
      ++whole;
      for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(made[3 * t + k], given[3 * s + k]);
    }
  }
  EXPECT_GT(whole, 0u);
}

}  // namespace meshrepair::testing
