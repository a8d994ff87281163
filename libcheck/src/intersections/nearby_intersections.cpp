// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

#include <base/ids.h>
#include <base/parallel.h>
#include <check/internal/nearby_intersections.h>
#include <check/internal/triangle_list.h>
#include <check/self_intersections.h>

namespace meshrepair::internal {
namespace {

// More say no more about where the faults are.
constexpr std::size_t kMostPairs = 200'000;

constexpr std::size_t kSearchesPerTask = 512;

}  // namespace

NearbyIntersections::NearbyIntersections(const TriangleSoup& mesh,
                                         std::span<const std::uint32_t> moving, double margin)
    : mesh_(mesh),
      tree_({}),
      part_index_(mesh.points.size(), kNone),
      is_in_part_(mesh.triangles.size(), 0) {
  find_around(moving, margin);
  boxes_.reserve(around_.size());
  for (const std::uint32_t t : around_) boxes_.push_back(box_around(t, margin));
  tree_ = BoxTree(boxes_);
}

Box NearbyIntersections::box_around(std::uint32_t triangle, double margin) const {
  Box box;
  for (const std::uint32_t p : mesh_.triangles[triangle]) box.add(mesh_.points[p]);
  box.widen(margin);
  return box;
}

void NearbyIntersections::find_around(std::span<const std::uint32_t> moving, double margin) {
  std::vector<Box> boxes;
  boxes.reserve(moving.size());
  for (const std::uint32_t t : moving) boxes.push_back(box_around(t, margin));
  around_ = triangles_near(mesh_, boxes, margin);
}

void NearbyIntersections::add(std::uint32_t triangle) {
  if (is_in_part_[triangle] != 0) return;
  is_in_part_[triangle] = 1;
  part_triangles_.push_back(triangle);
  std::array<std::uint32_t, 3> corners = mesh_.triangles[triangle];
  for (std::uint32_t& p : corners) {
    if (part_index_[p] == kNone) {
      part_index_[p] = static_cast<std::uint32_t>(part_.points.size());
      part_.points.push_back(mesh_.points[p]);
      part_points_.push_back(p);
    }
    p = part_index_[p];
  }
  part_.triangles.push_back(corners);
}

std::vector<NearbyIntersections::Pair> NearbyIntersections::find(
    std::span<const std::uint32_t> among, ProgressObserver* progress) {
  if (among.empty()) return {};
  part_.points.clear();
  part_.triangles.clear();
  part_triangles_.clear();
  part_points_.clear();
  for (const std::uint32_t t : among) add(t);
  std::vector<std::uint32_t> asked(part_triangles_.size());
  std::iota(asked.begin(), asked.end(), 0u);
  const auto find_near = [&](std::size_t first, std::size_t last) {
    std::vector<std::uint32_t> near;
    for (const std::uint32_t t : among.subspan(first, last - first)) {
      const Box box = box_around(t, 0);
      tree_.visit([&](const Box& other) { return other.meets(box); },
                  [&](std::uint32_t i) {
                    const bool is_known = is_in_part_[around_[i]] != 0;
                    if (!is_known && boxes_[i].meets(box)) near.push_back(around_[i]);
                  });
    }
    return near;
  };
  parallel_reduce(among.size(), kSearchesPerTask, find_near,
                  [&](std::vector<std::uint32_t>&, const std::vector<std::uint32_t>& near) {
                    for (const std::uint32_t t : near) add(t);
                  });
  SelfIntersectionOptions options;
  options.most_pairs = kMostPairs;
  options.progress = progress;
  std::vector<Pair> pairs = self_intersections(part_, asked, options).pairs;
  for (Pair& pair : pairs) {
    for (std::uint32_t& t : pair) t = part_triangles_[t];
    if (pair[0] > pair[1]) std::swap(pair[0], pair[1]);
  }
  for (const std::uint32_t p : part_points_) part_index_[p] = kNone;
  for (const std::uint32_t t : part_triangles_) is_in_part_[t] = 0;
  return pairs;
}

namespace {

// Enough that looking up takes longer than handing out the task.
constexpr std::size_t kBoxesPerTask = 16384;

}  // namespace

std::vector<std::uint32_t> triangles_near(const TriangleSoup& soup, std::span<const Box> boxes,
                                          double margin) {
  const BoxTree tree(boxes);
  const auto find = [&](std::size_t first, std::size_t last) {
    std::vector<std::uint32_t> near;
    for (std::size_t t = first; t < last; ++t) {
      const auto id = static_cast<std::uint32_t>(t);
      Box box = box_of(soup, id);
      box.widen(margin);
      if (meets_any(tree, boxes, box)) near.push_back(id);
    }
    return near;
  };
  return parallel_reduce(soup.triangles.size(), kBoxesPerTask, find,
                         [](std::vector<std::uint32_t>& all, std::vector<std::uint32_t> part) {
                           all.insert(all.end(), part.begin(), part.end());
                         });
}

}  // namespace meshrepair::internal
