#include <algorithm>
#include <bit>

#include <base/assert.h>
#include <base/error.h>
#include <base/first_equal.h>
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
    throw LimitError("more than 4294967294 distinct points");
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

PointPlaces find_places(const std::vector<Vec3d>& points) {
  PointPlaces places{first_in_place(points), std::vector<char>(points.size(), 0)};
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    const std::uint32_t place = places.place[p];
    if (place != p) places.is_copy[p] = places.is_copy[place] = 1;
  }
  return places;
}

}  // namespace meshrepair
