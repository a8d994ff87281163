// SPDX-License-Identifier: MIT
#include "facing_sources.h"

#include <algorithm>
#include <array>
#include <utility>

#include <Eigen/Geometry>

#include <base/ids.h>
#include <mesh/weld_points.h>

namespace meshrepair::internal {
namespace {

// A triangle by its places in rising order, and whether it runs through them in this order.
struct TriangleKey {
  std::array<std::uint32_t, 3> places;
  bool is_even = true;

  TriangleKey(const std::array<std::uint32_t, 3>& corners, const PointPlaces& at) {
    for (std::size_t k = 0; k < 3; ++k) places[k] = at.place[corners[k]];
    const auto order = [&](std::size_t i, std::size_t j) {
      if (places[i] <= places[j]) return;
      std::swap(places[i], places[j]);
      is_even = !is_even;
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
  }

  bool operator<(const TriangleKey& other) const {
    return std::pair(places, is_even) < std::pair(other.places, other.is_even);
  }
  bool operator==(const TriangleKey& other) const {
    return places == other.places && is_even == other.is_even;
  }
};

Vec3d normal_of(const TriangleSoup& soup, std::size_t t) {
  const auto& [a, b, c] = soup.triangles[t];
  return (soup.points[b] - soup.points[a]).cross(soup.points[c] - soup.points[a]);
}

std::vector<std::uint32_t> turned_triangles(const TriangleSoup& input, const Surface& surface) {
  std::vector<std::uint32_t> turned;
  for (std::uint32_t t = 0; t < surface.source.size(); ++t) {
    const std::uint32_t source = surface.source[t];
    if (source == Surface::kNoSource) continue;
    if (normal_of(surface.mesh, t).dot(normal_of(input, source)) < 0) turned.push_back(t);
  }
  return turned;
}

}  // namespace

std::vector<std::uint32_t> facing_sources(const TriangleSoup& input, const Surface& surface) {
  std::vector<std::uint32_t> sources = surface.source;
  const std::vector<std::uint32_t> turned = turned_triangles(input, surface);
  if (turned.empty()) return sources;
  const PointPlaces at = find_places(input.points);
  const auto wanted_of = [&](std::uint32_t t) {
    TriangleKey key(input.triangles[surface.source[t]], at);
    key.is_even = !key.is_even;
    return key;
  };
  std::vector<TriangleKey> wanted;
  wanted.reserve(turned.size());
  for (const std::uint32_t t : turned) wanted.push_back(wanted_of(t));
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  const auto find = [&](const TriangleKey& key) {
    const auto found = std::lower_bound(wanted.begin(), wanted.end(), key);
    return found != wanted.end() && *found == key ? static_cast<std::size_t>(found - wanted.begin())
                                                  : wanted.size();
  };
  std::vector<std::uint32_t> first(wanted.size() + 1, kNone);  // of the last: what is not wanted
  for (std::uint32_t s = 0; s < input.triangles.size(); ++s) {
    std::uint32_t& source = first[find(TriangleKey(input.triangles[s], at))];
    if (source == kNone) source = s;
  }
  first.back() = kNone;
  for (const std::uint32_t t : turned) {
    const std::uint32_t facing = first[find(wanted_of(t))];
    if (facing != kNone) sources[t] = facing;
  }
  return sources;
}

}  // namespace meshrepair::internal
