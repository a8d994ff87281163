// SPDX-License-Identifier: MIT
#include "state_bytes.h"

#include <array>

namespace meshrepair::internal {
namespace {

// What a plane is; the rest is computed from it.
struct Coefficients {
  std::array<std::int64_t, 3> normal;
  std::array<std::uint64_t, 2> offset;  // the lower half first
};

constexpr std::size_t kAtOnce = 4096;

Coefficients coefficients_of(const Plane& plane) {
  return {
      plane.normal,
      {static_cast<std::uint64_t>(plane.offset), static_cast<std::uint64_t>(plane.offset >> 64)}};
}

Plane plane_of(const Coefficients& c) {
  const auto high = static_cast<std::int64_t>(c.offset[1]);
  return make_plane(c.normal, (Int128{high} << 64) | Int128{c.offset[0]});
}

}  // namespace

void StateWriter::operator()(const PlaneTable& planes) {
  (*this)(static_cast<std::uint64_t>(planes.size()));
  std::vector<Coefficients> some;
  for (std::size_t first = 0; first < planes.size(); first += kAtOnce) {
    const std::size_t end = std::min(planes.size(), first + kAtOnce);
    some.clear();
    for (std::size_t p = first; p < end; ++p) some.push_back(coefficients_of(planes[PlaneId(p)]));
    put(some.data(), some.size());
  }
}

void StateReader::operator()(PlaneTable& planes) {
  const std::size_t size = take_size(sizeof(Coefficients));
  planes = {};
  planes.reserve(size);
  std::vector<Coefficients> some;
  for (std::size_t first = 0; first < size; first += kAtOnce) {
    some.resize(std::min(size - first, kAtOnce));
    take(some.data(), some.size());
    for (const Coefficients& c : some) planes.append(plane_of(c));
  }
}

}  // namespace meshrepair::internal
