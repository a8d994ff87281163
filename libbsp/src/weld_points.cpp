#include <algorithm>
#include <bit>
#include <limits>

#include <bsp/assert.h>
#include <bsp/error.h>
#include <bsp/weld_points.h>

namespace meshrepair {
namespace {

constexpr int kSmallestTableBits = 10;

std::uint64_t mix(std::uint64_t bits) { return (bits ^ (bits >> 32)) * 0x9E3779B97F4A7C15u; }

std::uint64_t hash(const Vec3d& point) {
  std::uint64_t bits = mix(std::bit_cast<std::uint64_t>(point.x()));
  bits = mix(bits ^ std::bit_cast<std::uint64_t>(point.y()));
  return mix(bits ^ std::bit_cast<std::uint64_t>(point.z()));
}

bool same_bits(const Vec3d& a, const Vec3d& b) {
  const auto differ = [&](int i) {
    return std::bit_cast<std::uint64_t>(a[i]) ^ std::bit_cast<std::uint64_t>(b[i]);
  };
  return (differ(0) | differ(1) | differ(2)) == 0;
}

}  // namespace

PointWelder::PointWelder(std::vector<Vec3d>& points, std::size_t expected) : points_(points) {
  MESHREPAIR_ASSERT(points.empty());
  points_.reserve(expected);
  const int width = static_cast<int>(std::bit_width(2 * expected));
  const int bits = std::max(kSmallestTableBits, width);
  slots_.assign(std::size_t{1} << bits, 0);
  shift_ = 64 - bits;
}

std::uint32_t PointWelder::index_of(Vec3d point) {
  point.array() += 0.0;  // -0 + 0 is 0
  std::size_t slot = hash(point) >> shift_;
  while (slots_[slot] != 0) {
    const std::uint32_t index = slots_[slot] - 1;
    if (same_bits(points_[index], point)) return index;
    slot = (slot + 1) & (slots_.size() - 1);
  }
  constexpr std::size_t kMostPoints = std::numeric_limits<std::uint32_t>::max() - 1;
  if (points_.size() == kMostPoints) throw LimitError("more than 4294967294 distinct points");
  points_.push_back(point);
  slots_[slot] = static_cast<std::uint32_t>(points_.size());
  if (2 * points_.size() > slots_.size()) grow();
  return static_cast<std::uint32_t>(points_.size() - 1);
}

void PointWelder::grow() {
  --shift_;
  slots_.assign(2 * slots_.size(), 0);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    std::size_t slot = hash(points_[i]) >> shift_;
    while (slots_[slot] != 0) slot = (slot + 1) & (slots_.size() - 1);
    slots_[slot] = static_cast<std::uint32_t>(i + 1);
  }
}

}  // namespace meshrepair
