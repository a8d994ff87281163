#include <algorithm>
#include <array>
#include <utility>

#include <base/ids.h>
#include <check/known_intersections.h>
#include <check/triangle_list.h>

#include "compare_triangles.h"
#include "nearby_part.h"

namespace meshrepair::internal {
namespace {

// As if the triangles listed had been compared within the whole.
SelfIntersections compare_nearby(const TriangleSoup& mesh, const std::vector<std::uint32_t>& among,
                                 const SelfIntersectionOptions& options) {
  const NearbyPart part = nearby_part(mesh, among, 0);
  const SoupCorners corners(part.soup, true);
  const TriangleList list(corners, part.among);
  SelfIntersections result = compare_with(corners, list, options);
  for (auto& pair : result.pairs) pair = {part.triangles[pair[0]], part.triangles[pair[1]]};
  return result;
}

// Of the corners of each triangle, ascending.
std::vector<IndexTriangle> places_of(const SoupCorners& corners) {
  std::vector<IndexTriangle> triangles;
  triangles.reserve(corners.soup().triangles.size());
  for (const auto& triangle : corners.soup().triangles) {
    IndexTriangle places{};
    for (std::size_t k = 0; k < 3; ++k) places[k] = corners.corner(triangle[k]);
    std::sort(places.begin(), places.end());
    triangles.push_back(places);
  }
  return triangles;
}

// Of each triangle whether it is to be compared again, even if it stays. If not all pairs are
// listed, every one is.
std::vector<char> find_doubtful(const SoupCorners& corners, const SelfIntersections& found) {
  const std::size_t count = corners.soup().triangles.size();
  if (found.count > found.pairs.size()) return std::vector<char>(count, 1);
  std::vector<char> doubtful(count, 0);
  for (const auto& pair : found.pairs) doubtful[pair[0]] = doubtful[pair[1]] = 1;
  if (found.degenerate + found.not_finite == 0) return doubtful;
  CornerTriangle triangle;
  for (std::uint32_t t = 0; t < count; ++t) {
    if (corners.fetch(t, triangle) != Fetched::usable) doubtful[t] = 1;
  }
  return doubtful;
}

}  // namespace

KnownIntersections::KnownIntersections(std::size_t most_pairs, ProgressObserver* progress)
    : welder_(places_) {
  options_.most_pairs = most_pairs;
  options_.progress = progress;
}

SelfIntersections KnownIntersections::find(const TriangleSoup& mesh) {
  std::vector<std::uint32_t> place_of_point = place_points(mesh);
  const SoupCorners corners(mesh, std::move(place_of_point), places_.size());
  const std::vector<IndexTriangle> triangles = places_of(corners);
  const std::vector<std::uint32_t> fresh = find_fresh(triangles);
  const bool few = fresh.size() <= triangles.size() / kFew;
  SelfIntersections found =
      few ? compare_nearby(mesh, fresh, options_) : compare_all(corners, options_);
  add_crossing_sheets(corners, {}, options_, found);
  remember(triangles, find_doubtful(corners, found));
  return found;
}

std::vector<std::uint32_t> KnownIntersections::place_points(const TriangleSoup& mesh) {
  std::vector<std::uint32_t> places;
  places.reserve(mesh.points.size());
  for (const Vec3d& point : mesh.points) places.push_back(welder_.index_of(point));
  return places;
}

// Those that are not known, and all but one of those in one place, and that one.
std::vector<std::uint32_t> KnownIntersections::find_fresh(
    const std::vector<IndexTriangle>& triangles) const {
  std::vector<std::uint32_t> fresh;
  std::vector<std::uint32_t> taken_by(others_.size(), kNone);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const std::size_t known = find_known(triangles[t]);
    if (known == others_.size()) {
      fresh.push_back(t);
    } else if (taken_by[known] == kNone) {
      taken_by[known] = t;
    } else {
      fresh.insert(fresh.end(), {taken_by[known], t});
    }
  }
  return fresh;
}

// Behind the last one: not known.
std::size_t KnownIntersections::find_known(const IndexTriangle& places) const {
  if (std::size_t{places[0]} + 1 >= first_.size()) return others_.size();
  const std::array others{places[1], places[2]};
  const auto end = others_.begin() + first_[places[0] + 1];
  const auto found = std::lower_bound(others_.begin() + first_[places[0]], end, others);
  if (found == end || *found != others) return others_.size();
  return static_cast<std::size_t>(found - others_.begin());
}

void KnownIntersections::remember(const std::vector<IndexTriangle>& triangles,
                                  const std::vector<char>& doubtful) {
  first_.assign(places_.size() + 1, 0);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (doubtful[t] == 0) ++first_[triangles[t][0] + 1];
  }
  for (std::size_t place = 0; place < places_.size(); ++place) first_[place + 1] += first_[place];
  others_.resize(first_.back());
  std::vector<std::uint32_t> next = first_;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (doubtful[t] != 0) continue;
    others_[next[triangles[t][0]]++] = {triangles[t][1], triangles[t][2]};
  }
  // Very many may have one place in common.
  for (std::size_t place = 0; place < places_.size(); ++place) {
    std::sort(others_.begin() + first_[place], others_.begin() + first_[place + 1]);
  }
}

}  // namespace meshrepair::internal
