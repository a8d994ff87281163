// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <base/assert.h>
#include <base/error.h>
#include <base/first_equal.h>
#include <base/ids.h>
#include <mesh/mesh_limits.h>
#include <mesh/weld_points.h>

namespace meshrepair {
namespace {

using internal::hash_mix;
using internal::HashIndex;

static_assert(kMostPoints <= HashIndex::kNone);  // which every position is below

std::uint64_t hash(const Vec3d& point) {
  std::uint64_t h = hash_mix(0, std::bit_cast<std::uint64_t>(point.x()));
  h = hash_mix(h, std::bit_cast<std::uint64_t>(point.y()));
  return hash_mix(h, std::bit_cast<std::uint64_t>(point.z()));
}

Vec3d without_negative_zero(const Vec3d& point) { return point.array() + 0.0; }

bool same_bits(const Vec3d& a, const Vec3d& b) {
  const auto differ = [&](int i) {
    return std::bit_cast<std::uint64_t>(a[i]) ^ std::bit_cast<std::uint64_t>(b[i]);
  };
  return (differ(0) | differ(1) | differ(2)) == 0;
}

// How many items are looked ahead for where two lists go on alike.
constexpr std::size_t kWindow = 64;
// Of all points that are not found in order: what is found by hashing is not worth more passes.
constexpr std::size_t kManyOthers = 8;

// How many of each list to pass by until they go on alike, as far as one can see from `i` and `j`.
std::pair<std::size_t, std::size_t> steps_to_agree(const std::vector<Vec3d>& points, std::size_t i,
                                                   const std::vector<Vec3d>& before,
                                                   std::size_t j) {
  const auto agree = [&](std::size_t m, std::size_t n) {
    return i + m < points.size() && j + n < before.size() && points[i + m] == before[j + n];
  };
  for (std::size_t s = 1; s <= kWindow; ++s) {
    if (agree(s, s)) return {s, s};
    if (agree(0, s)) return {0, s};
    if (agree(s, 0)) return {s, 0};
  }
  return {1, 1};
}

struct PointsInOrder {
  std::vector<std::uint32_t> before;  // of each point one of `before` in its place, or kNone
  std::vector<std::uint32_t> others;  // points that have none, ascending
};

// Ends early with many others.
PointsInOrder points_in_order(const std::vector<Vec3d>& before, const std::vector<Vec3d>& points) {
  PointsInOrder found{std::vector<std::uint32_t>(points.size(), kNone), {}};
  std::size_t i = 0, j = 0;
  while (i < points.size() && kManyOthers * found.others.size() <= points.size()) {
    if (j < before.size() && points[i] == before[j]) {
      found.before[i++] = static_cast<std::uint32_t>(j++);
      continue;
    }
    const auto [of_points, of_before] = steps_to_agree(points, i, before, j);
    for (std::size_t n = 0; n < of_points; ++n) {
      found.others.push_back(static_cast<std::uint32_t>(i++));
    }
    j += of_before;
  }
  return found;
}

// For each of `points` listed the first one of `before`, or else of those listed, in its place.
std::vector<std::uint32_t> find_listed(const std::vector<Vec3d>& before,
                                       const std::vector<Vec3d>& points,
                                       const std::vector<std::uint32_t>& listed) {
  const auto listed_point = [&](std::size_t e) { return without_negative_zero(points[listed[e]]); };
  std::vector<std::uint32_t> first(listed.size()), result(listed.size());
  HashIndex index(listed.size());
  for (std::uint32_t e = 0; e < listed.size(); ++e) {
    const Vec3d point = listed_point(e);
    first[e] = index.find_or_insert(
        hash(point), e, [&](std::uint32_t other) { return same_bits(listed_point(other), point); });
    result[e] = static_cast<std::uint32_t>(before.size()) + listed[e];
  }
  for (auto j = static_cast<std::uint32_t>(before.size()); j-- > 0;) {
    const Vec3d point = without_negative_zero(before[j]);
    const std::uint32_t e = index.find(
        hash(point), [&](std::uint32_t other) { return same_bits(listed_point(other), point); });
    if (e != HashIndex::kNone) result[e] = j;
  }
  for (std::size_t e = 0; e < listed.size(); ++e) result[e] = result[first[e]];
  return result;
}

}  // namespace

PointWelder::PointWelder(std::vector<Vec3d>& points, std::size_t expected)
    : points_(points), index_(expected) {
  MESHREPAIR_ASSERT(points.empty());
  points_.reserve(expected);
}

std::uint32_t PointWelder::index_of(Vec3d point) {
  point = without_negative_zero(point);
  const std::uint64_t key = hash(point);
  const auto same = [&](std::uint32_t index) { return same_bits(points_[index], point); };
  if (points_.size() == kMostPoints && index_.find(key, same) == HashIndex::kNone) {
    require_points(points_.size() + std::uint64_t{1});
  }
  const auto fresh = static_cast<std::uint32_t>(points_.size());
  const std::uint32_t index = index_.find_or_insert(key, fresh, same);
  if (index != fresh) return index;
  points_.push_back(point);
  if (index_.full(points_.size())) {
    index_.grow(fresh + 1, [&](std::uint32_t i) { return hash(points_[i]); });
  }
  return fresh;
}

std::vector<std::uint32_t> first_in_place(const std::vector<Vec3d>& points) {
  return first_in_place({}, points);
}

std::vector<std::uint32_t> first_in_place(const std::vector<Vec3d>& before,
                                          const std::vector<Vec3d>& points) {
  const auto point = [&](std::size_t p) -> Vec3d {
    return without_negative_zero(p < before.size() ? before[p] : points[p - before.size()]);
  };
  std::vector<std::uint32_t> first = first_equal(
      before.size() + points.size(), [&](std::size_t p) { return hash(point(p)); },
      [&](std::size_t p, std::size_t q) { return same_bits(point(p), point(q)); });
  first.erase(first.begin(), first.begin() + static_cast<std::ptrdiff_t>(before.size()));
  return first;
}

std::vector<std::uint32_t> first_in_place(const std::vector<Vec3d>& before,
                                          const std::vector<std::uint32_t>& first_before,
                                          const std::vector<Vec3d>& points) {
  PointsInOrder found = points_in_order(before, points);
  if (kManyOthers * found.others.size() > points.size()) return first_in_place(before, points);
  std::vector<std::uint32_t> first = std::move(found.before);
  for (std::uint32_t& p : first) {
    if (p != kNone) p = first_before[p];
  }
  if (found.others.empty()) return first;
  const std::vector<std::uint32_t> places = find_listed(before, points, found.others);
  for (std::size_t e = 0; e < places.size(); ++e) first[found.others[e]] = places[e];
  return first;
}

PointPlaces find_places(const std::vector<Vec3d>& points) {
  PointPlaces places{first_in_place(points), std::vector<char>(points.size(), 0)};
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    const std::uint32_t place = places.place[p];
    if (place != p) places.is_copy[p] = places.is_copy[place] = 1;
  }
  return places;
}

}  // namespace meshrepair
