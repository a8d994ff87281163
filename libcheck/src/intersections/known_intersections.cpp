// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <utility>

#include <base/buckets.h>
#include <base/ids.h>
#include <base/parallel.h>
#include <check/internal/known_intersections.h>
#include <check/internal/triangle_list.h>
#include <mesh/weld_points.h>

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

constexpr std::size_t kPlacesPerTask = 16384;
// Of lowest corners, for sorting.
constexpr std::size_t kMostBuckets = 512, kFewestCorners = 1024;

// Of the corners of each triangle, ascending.
std::vector<IndexTriangle> places_of(const SoupCorners& corners) {
  const auto& soup = corners.soup();
  std::vector<IndexTriangle> triangles(soup.triangles.size());
  parallel_tasks(triangles.size(), kPlacesPerTask,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t t = first; t < last; ++t) {
                     for (std::size_t k = 0; k < 3; ++k) {
                       triangles[t][k] = corners.corner(soup.triangles[t][k]);
                     }
                     std::sort(triangles[t].begin(), triangles[t].end());
                   }
                 });
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

KnownIntersections::KnownIntersections(std::size_t most_pairs, ProgressObserver* progress) {
  options_.most_pairs = most_pairs;
  options_.progress = progress;
}

SelfIntersections KnownIntersections::find(const TriangleSoup& mesh) {
  const SoupCorners corners(mesh, first_in_place(points_, places_, mesh.points),
                            points_.size() + mesh.points.size());
  SelfIntersections found = compare(corners);
  add_crossing_sheets(corners, {}, options_, found);
  remember(mesh, corners, find_doubtful(corners, found));
  return found;
}

SelfIntersections KnownIntersections::compare(const SoupCorners& corners) const {
  if (others_.empty()) return compare_all(corners, options_);
  const std::vector<std::uint32_t> fresh = find_fresh(places_of(corners));
  const bool few = fresh.size() <= corners.soup().triangles.size() / kFew;
  return few ? compare_nearby(corners.soup(), fresh, options_) : compare_all(corners, options_);
}

// Those that are not known, and all but one of those in one place, and that one.
std::vector<std::uint32_t> KnownIntersections::find_fresh(
    const std::vector<IndexTriangle>& triangles) const {
  std::vector<std::uint32_t> known(triangles.size());
  parallel_tasks(triangles.size(), kPlacesPerTask,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t t = first; t < last; ++t) known[t] = find_known(triangles[t]);
                 });
  std::vector<std::uint32_t> fresh;
  std::vector<std::uint32_t> taken_by(others_.size(), kNone);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (known[t] == kNone) {
      fresh.push_back(t);
    } else if (taken_by[known[t]] == kNone) {
      taken_by[known[t]] = t;
    } else {
      fresh.insert(fresh.end(), {taken_by[known[t]], t});
    }
  }
  return fresh;
}

// kNone: not known.
std::uint32_t KnownIntersections::find_known(const IndexTriangle& places) const {
  if (std::size_t{places[0]} + 1 >= first_.size()) return kNone;
  const std::array others{places[1], places[2]};
  const auto behind = [&](std::uint32_t n) {
    return others_.begin() + static_cast<std::ptrdiff_t>(first_[n]);
  };
  const auto end = behind(places[0] + 1);
  const auto found = std::lower_bound(behind(places[0]), end, others);
  if (found == end || *found != others) return kNone;
  return static_cast<std::uint32_t>(found - others_.begin());
}

void KnownIntersections::remember(const TriangleSoup& mesh, const SoupCorners& corners,
                                  const std::vector<char>& doubtful) {
  const std::size_t points = mesh.points.size();
  std::vector<std::uint32_t> own(corners.end(), kNone);  // of each place
  for (std::uint32_t p = 0; p < points; ++p) {
    std::uint32_t& first = own[corners.corner(p)];
    if (first == kNone) first = p;
  }
  const auto corners_of = [&](std::size_t t) {
    IndexTriangle triangle{};
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = own[corners.corner(mesh.triangles[t][k])];
    std::sort(triangle.begin(), triangle.end());
    return triangle;
  };
  const std::size_t corners_each = std::max(kFewestCorners, tasks_of(points, kMostBuckets));
  Buckets<IndexTriangle> buckets(mesh.triangles.size(), tasks_of(points, corners_each),
                                 [&](std::size_t t, const auto& put) {
                                   if (doubtful[t] != 0) return;
                                   const IndexTriangle triangle = corners_of(t);
                                   put(triangle[0] / corners_each, triangle);
                                 });
  first_.assign(points + 1, buckets.first(buckets.size()));
  others_.resize(first_.back());
  parallel_for(buckets.size(), [&](std::size_t b) {
    const auto bucket = buckets[b];
    std::sort(bucket.begin(), bucket.end());
    std::size_t i = 0;
    for (std::size_t p = b * corners_each; p < std::min(points, (b + 1) * corners_each); ++p) {
      first_[p] = buckets.first(b) + static_cast<std::uint32_t>(i);
      for (; i < bucket.size() && bucket[i][0] == p; ++i) {
        others_[buckets.first(b) + i] = {bucket[i][1], bucket[i][2]};
      }
    }
  });
  places_.resize(points);
  for (std::uint32_t p = 0; p < points; ++p) places_[p] = own[corners.corner(p)];
  points_ = mesh.points;
}

}  // namespace meshrepair::internal
