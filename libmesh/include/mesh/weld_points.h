// SPDX-License-Identifier: MIT
// Welding: equal points become one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <base/internal/hash_index.h>
#include <mesh/soup.h>

namespace meshrepair {

// Gives every distinct point a number, in order of first appearance. Points are equal when their
// coordinates have the same bits; -0 is turned into 0 before. No tolerance: points that differ in
// the last bit stay apart.
class PointWelder {
 public:
  // `points` receives the distinct points and must be empty; it may grow to `expected` cheaply.
  explicit PointWelder(std::vector<Vec3d>& points, std::size_t expected = 0);

  // Position in `points` of the point equal to this one. Throws LimitError beyond 2^32 - 2 points.
  std::uint32_t index_of(Vec3d point);

 private:
  std::vector<Vec3d>& points_;
  internal::HashIndex index_;
};

// For each point the first one that has its place. On several threads.
[[nodiscard]] std::vector<std::uint32_t> first_in_place(const std::vector<Vec3d>& points);

// For each of `points` the first one of both lists, one after the other, that has its place.
[[nodiscard]] std::vector<std::uint32_t> first_in_place(const std::vector<Vec3d>& before,
                                                        const std::vector<Vec3d>& points);

// The same where first_in_place(before) is known. The work is for points that `before` does not
// have in the same order, besides passes that go through both lists from front to back.
[[nodiscard]] std::vector<std::uint32_t> first_in_place(
    const std::vector<Vec3d>& before, const std::vector<std::uint32_t>& first_before,
    const std::vector<Vec3d>& points);

// Points by where they lie.
struct PointPlaces {
  std::vector<std::uint32_t> place;  // of each point the first one that is there
  std::vector<char> is_copy;         // of each point: has another one its place?
};

[[nodiscard]] PointPlaces find_places(const std::vector<Vec3d>& points);

}  // namespace meshrepair
