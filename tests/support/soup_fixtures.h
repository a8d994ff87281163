// SPDX-License-Identifier: MIT
// Small soups and the means to read and compare them, for the tests of the file formats.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>
#include <mesh/soup_io.h>

namespace meshrepair {

using Triangle = std::array<std::uint32_t, 3>;

inline ReadResult read_text(const std::string& bytes, const std::string& name) {
  return read_soup(std::string_view(bytes), name);
}

// The message of the InputError that reading these bytes throws; empty, and a failure, if none
// does.
inline std::string refusal_of(const std::string& bytes, const std::string& name) {
  try {
    read_text(bytes, name);
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << name << " was not refused";
  return {};
}

inline TriangleSoup tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{{0, 2, 1}}, {{0, 1, 3}}, {{1, 2, 3}}, {{0, 3, 2}}}};
}

// Points whose coordinates are random bits, so of every magnitude, all finite; triangles of any
// corners. Single precision only if the file format holds no more.
inline TriangleSoup random_soup(std::uint64_t seed, bool single_precision) {
  std::mt19937_64 random(seed);
  const auto coordinate = [&]() -> double {
    for (;;) {
      const double value = single_precision
                               ? std::bit_cast<float>(static_cast<std::uint32_t>(random()))
                               : std::bit_cast<double>(random());
      if (std::isfinite(value)) return value;
    }
  };
  TriangleSoup soup;
  for (int i = 0; i < 200; ++i) {
    const double x = coordinate();
    const double y = coordinate();
    soup.points.emplace_back(x, y, coordinate());
  }
  const auto corner = [&] { return static_cast<std::uint32_t>(random() % soup.points.size()); };
  for (int i = 0; i < 300; ++i) {
    const std::uint32_t a = corner();
    const std::uint32_t b = corner();
    soup.triangles.push_back({a, b, corner()});
  }
  return soup;
}

// The bits of all coordinates of all corners, in order: what an STL keeps of a soup.
inline std::vector<std::uint64_t> corner_bits(const TriangleSoup& soup) {
  std::vector<std::uint64_t> bits;
  for (const Triangle& triangle : soup.triangles) {
    for (const std::uint32_t corner : triangle) {
      for (const double value : soup.points[corner])
        bits.push_back(std::bit_cast<std::uint64_t>(value));
    }
  }
  return bits;
}

inline std::vector<std::uint64_t> point_bits(const TriangleSoup& soup) {
  std::vector<std::uint64_t> bits;
  for (const Vec3d& point : soup.points) {
    for (const double value : point) bits.push_back(std::bit_cast<std::uint64_t>(value));
  }
  return bits;
}

inline void expect_valid_indices(const TriangleSoup& soup) {
  for (const Triangle& triangle : soup.triangles) {
    for (const std::uint32_t corner : triangle) ASSERT_LT(corner, soup.points.size());
  }
}

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos;
       at = text.find(what, at + by.size())) {
    text.replace(at, what.size(), by);
  }
  return text;
}

}  // namespace meshrepair
