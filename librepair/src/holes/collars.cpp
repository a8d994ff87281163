// SPDX-License-Identifier: MIT
#include "collars.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace meshrepair::internal {
namespace {

// A point's place on a loop.
struct Place {
  std::uint32_t point, loop, position;
};

using LoopTriangle = std::pair<std::uint32_t, std::uint32_t>;

std::vector<Place> places_on(const BoundaryLoops& loops) {
  std::vector<Place> places;
  for (std::uint32_t l = 0; l < loops.loops(); ++l) {
    std::uint32_t position = 0;
    for (const std::uint32_t p : loops.points_of(l)) places.push_back({p, l, position++});
  }
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return std::tie(a.point, a.loop) < std::tie(b.point, b.loop);
  });
  return places;
}

std::span<const Place> places_of(std::span<const Place> places, std::uint32_t point) {
  const auto before = [](const Place& place, std::uint32_t p) { return place.point < p; };
  const auto after = [](std::uint32_t p, const Place& place) { return p < place.point; };
  const auto from = std::lower_bound(places.begin(), places.end(), point, before);
  const auto to = std::upper_bound(from, places.end(), point, after);
  return {from, to};
}

std::vector<LoopTriangle> triangles_at(std::span<const IndexTriangle> triangles,
                                       std::span<const Place> places, std::size_t points) {
  std::vector<char> at_loop(points, 0);
  for (const Place& place : places) at_loop[place.point] = 1;
  std::vector<LoopTriangle> found;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (const std::uint32_t corner : triangles[t]) {
      if (at_loop[corner] == 0) continue;
      for (const Place& place : places_of(places, corner)) found.push_back({place.loop, t});
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace

std::vector<Collar> find_collars(const CleanSoup& soup, std::span<const IndexTriangle> triangles,
                                 const BoundaryLoops& loops) {
  const std::vector<Place> places = places_on(loops);
  std::vector<Collar> collars(loops.loops());
  std::vector<std::vector<std::uint32_t>> others(loops.loops());  // of each collar, sorted later
  const auto found = triangles_at(triangles, places, soup.points.size());
  const auto on_rim = [&](std::uint32_t point, std::uint32_t loop) -> const Place* {
    for (const Place& place : places_of(places, point)) {
      if (place.loop == loop) return &place;
    }
    return nullptr;
  };
  for (const auto& [loop, t] : found) {
    for (const std::uint32_t corner : triangles[t]) {
      if (on_rim(corner, loop) == nullptr) others[loop].push_back(corner);
    }
  }
  for (std::size_t l = 0; l < collars.size(); ++l) {
    std::sort(others[l].begin(), others[l].end());
    others[l].erase(std::unique(others[l].begin(), others[l].end()), others[l].end());
    for (const std::uint32_t p : others[l]) {
      collars[l].points.push_back(as_vector(soup.grid_points[PointId(p)]));
    }
  }
  for (const auto& [loop, t] : found) {
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (const Place* place = on_rim(triangles[t][k], loop)) {
        corners[k] = place->position;
      } else {
        const auto at = std::lower_bound(others[loop].begin(), others[loop].end(), triangles[t][k]);
        corners[k] = static_cast<std::uint32_t>(
            loops.points_of(loop).size() + static_cast<std::size_t>(at - others[loop].begin()));
      }
    }
    collars[loop].triangles.push_back(corners);
  }
  return collars;
}

}  // namespace meshrepair::internal
