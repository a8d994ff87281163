// SPDX-License-Identifier: MIT
#include "page/pack_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <base/base64.h>
#include <mesh/packing.h>

#include "page/packed_numbers.h"

namespace meshrepair {
namespace {

constexpr std::uint32_t kNew = std::numeric_limits<std::uint32_t>::max();

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

void append_all(std::size_t count, const auto& numbers, std::string& out) {
  for (std::size_t i = 0; i < count; ++i) append_number(out, numbers.empty() ? 0 : numbers[i]);
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

std::string pack_mesh(const DrawnMesh& mesh, const PageGrid& grid, ProgressObserver* progress) {
  const TriangleSoup& soup = mesh.soup;
  std::string bytes;
  std::vector<std::uint32_t> number_of(soup.points.size(), kNew);
  std::vector<std::uint32_t> order;
  for (const auto& t : soup.triangles) {
    for (const std::uint32_t p : t) {
      const auto next = static_cast<std::uint32_t>(order.size());
      append_number(bytes, number_of[p] == kNew ? 0 : next - number_of[p]);
      if (number_of[p] != kNew) continue;
      number_of[p] = next;
      order.push_back(p);
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::int32_t before = 0;
    for (const std::uint32_t p : order) {
      const std::int32_t now = grid.steps_of(soup.points[p])[axis];
      append_signed(bytes, now - before);
      before = now;
    }
  }
  append_all(soup.triangles.size(), mesh.kinds, bytes);
  append_all(soup.triangles.size(), mesh.marks, bytes);
  if (!mesh.values.empty()) {
    for (const std::uint32_t p : order) append_number(bytes, mesh.values[p]);
  }
  return encode_base64(pack_bytes(bytes, Packing::gzip, progress));
}

}  // namespace meshrepair
