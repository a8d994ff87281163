#include "page/pack_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <base/base64.h>
#include <mesh/packing.h>

namespace meshrepair {
namespace {

constexpr std::uint32_t kNew = std::numeric_limits<std::uint32_t>::max();

void append_number(std::string& out, std::uint32_t value) {
  while (value >= 0x80) {
    out += static_cast<char>(value | 0x80);
    value >>= 7;
  }
  out += static_cast<char>(value);
}

void append_signed(std::string& out, std::int32_t value) {
  const auto bits = static_cast<std::uint32_t>(value);
  append_number(out, (bits << 1) ^ (value < 0 ? ~0u : 0u));
}

// Finite; nothing where there are none.
struct Bounds {
  Vec3d low = Vec3d::Constant(std::numeric_limits<double>::max());
  Vec3d high = Vec3d::Constant(std::numeric_limits<double>::lowest());

  void add(const TriangleSoup& soup) {
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
      if (!is_finite(soup, t)) continue;
      for (const std::uint32_t p : soup.triangles[t]) {
        low = low.cwiseMin(soup.points[p]);
        high = high.cwiseMax(soup.points[p]);
      }
    }
  }
  [[nodiscard]] bool empty() const { return low.x() > high.x(); }
};

// Every so many of a list, so that `wanted` are left.
void append_evenly(const std::vector<std::uint32_t>& from, std::size_t wanted,
                   std::vector<std::uint32_t>& to) {
  for (std::size_t i = 0; i < wanted; ++i) to.push_back(from[i * from.size() / wanted]);
}

}  // namespace

PageGrid::Steps PageGrid::steps_of(const Vec3d& point) const {
  Steps steps{};
  if (!(half > 0)) return steps;
  for (int axis = 0; axis < 3; ++axis) {
    const double share = (point[axis] / 2 - low[axis] / 2) / half;
    steps[static_cast<std::size_t>(axis)] =
        static_cast<std::int32_t>(std::lround(std::clamp(share, 0.0, 1.0) * kMost));
  }
  return steps;
}

bool is_finite(const TriangleSoup& soup, std::uint32_t triangle) {
  const auto& corners = soup.triangles[triangle];
  return std::all_of(corners.begin(), corners.end(),
                     [&](std::uint32_t p) { return soup.points[p].allFinite(); });
}

PageGrid grid_of(const std::vector<const TriangleSoup*>& soups) {
  Bounds bounds;
  for (const TriangleSoup* soup : soups) bounds.add(*soup);
  PageGrid grid;
  if (bounds.empty()) return grid;
  grid.low = bounds.low;
  grid.half = (bounds.high / 2 - bounds.low / 2).maxCoeff();
  grid.high = grid.steps_of(bounds.high);
  return grid;
}

PageGrid::Steps sides_of(const TriangleSoup& soup, const PageGrid& grid) {
  Bounds bounds;
  bounds.add(soup);
  if (bounds.empty()) return {};
  PageGrid::Steps sides = grid.steps_of(bounds.high);
  const PageGrid::Steps low = grid.steps_of(bounds.low);
  for (std::size_t axis = 0; axis < 3; ++axis) sides[axis] -= low[axis];
  return sides;
}

std::vector<std::uint32_t> choose_triangles(const TriangleSoup& soup,
                                            std::span<const std::uint16_t> marks,
                                            std::size_t most) {
  std::vector<std::uint32_t> marked;
  std::vector<std::uint32_t> others;
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    if (is_finite(soup, t)) (marks[t] != 0 ? marked : others).push_back(t);
  }
  std::vector<std::uint32_t> chosen;
  append_evenly(marked, std::min(most, marked.size()), chosen);
  append_evenly(others, std::min(most - chosen.size(), others.size()), chosen);
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

std::string pack_mesh(const TriangleSoup& soup, std::span<const std::uint32_t> chosen,
                      std::span<const std::uint32_t> kinds, std::span<const std::uint16_t> marks,
                      const PageGrid& grid, ProgressObserver* progress) {
  std::string bytes;
  std::vector<std::uint32_t> number_of(soup.points.size(), kNew);
  std::vector<PageGrid::Steps> places;
  for (const std::uint32_t t : chosen) {
    for (const std::uint32_t p : soup.triangles[t]) {
      const auto next = static_cast<std::uint32_t>(places.size());
      append_number(bytes, number_of[p] == kNew ? 0 : next - number_of[p]);
      if (number_of[p] != kNew) continue;
      number_of[p] = next;
      places.push_back(grid.steps_of(soup.points[p]));
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::int32_t before = 0;
    for (const PageGrid::Steps& place : places) {
      append_signed(bytes, place[axis] - before);
      before = place[axis];
    }
  }
  for (const std::uint32_t t : chosen) append_number(bytes, kinds.empty() ? 0 : kinds[t]);
  for (const std::uint32_t t : chosen) append_number(bytes, marks[t]);
  return encode_base64(pack_bytes(bytes, Packing::gzip, progress));
}

}  // namespace meshrepair
