// SPDX-License-Identifier: MIT
#include "point_columns.h"

#include <algorithm>
#include <cmath>

namespace meshrepair {
namespace {

// Where a triple may begin: right behind x, y, z, behind an intensity, behind another triple.
constexpr std::array<std::size_t, 4> kPlaces = {3, 4, 6, 7};

// Of lines that say something, nearly all.
constexpr double kMostLines = 0.8;

bool has_triple(const PointLine& line, std::size_t at) { return line.count >= at + 3; }

// Colours from 0 to 1 of length 1 are pure red, green and blue. Normals that look the same all lie
// along an axis, and are not missed.
bool may_be_pure_colours(std::span<const PointLine> lines, std::size_t at) {
  return std::all_of(lines.begin(), lines.end(), [&](const PointLine& line) {
    const Vec3d triple = line.triple(at);
    return triple.minCoeff() >= 0 && triple == Vec3d(triple.array().floor());
  });
}

bool are_normals(std::span<const PointLine> lines, std::size_t at) {
  constexpr double kNearOne = 0.05;
  std::size_t known = 0;
  std::size_t of_length_one = 0;
  for (const PointLine& line : lines) {
    if (!has_triple(line, at)) return false;
    const double length = line.triple(at).norm();
    if (length == 0 || std::isnan(length)) continue;
    ++known;
    of_length_one += std::abs(length - 1) < kNearOne;
  }
  return known > 0 &&
         static_cast<double>(of_length_one) >= kMostLines * static_cast<double>(known) &&
         !may_be_pure_colours(lines, at);
}

bool are_colours(std::span<const PointLine> lines, std::size_t at) {
  return !lines.empty() && std::all_of(lines.begin(), lines.end(), [&](const PointLine& line) {
    if (!has_triple(line, at)) return false;
    const Vec3d colour = line.triple(at);
    return colour.minCoeff() >= 0 && colour.maxCoeff() <= 255 &&
           colour == Vec3d(colour.array().floor());
  });
}

}  // namespace

PointColumns guess_columns(std::span<const PointLine> lines) {
  PointColumns columns;
  const auto overlaps = [&](std::size_t at) {
    return columns.normal != 0 && at < columns.normal + 3 && columns.normal < at + 3;
  };
  for (const std::size_t at : kPlaces) {
    if (columns.normal == 0 && are_normals(lines, at)) columns.normal = at;
  }
  for (const std::size_t at : kPlaces) {
    if (columns.colour == 0 && !overlaps(at) && are_colours(lines, at)) columns.colour = at;
  }
  return columns;
}

std::uint8_t to_colour(double value) {
  if (!(value > 0)) return 0;
  return static_cast<std::uint8_t>(std::lround(std::min(value, 255.0)));
}

}  // namespace meshrepair
