// SPDX-License-Identifier: MIT
#include "corner_clusters.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include <base/parallel.h>
#include <check/box_tree.h>

namespace meshrepair::internal {
namespace {

// Corners near another, on average: a vertex of a soup has six triangles.
constexpr std::size_t kMostNear = 64;

// Between two questions whether to go on.
constexpr std::size_t kSearchesAtATime = 16384;
constexpr std::size_t kSearchesPerTask = 256;

}  // namespace

CornerClusters::CornerClusters(const TriangleSoup& soup, const OpenRims& rims)
    : soup_(soup), rims_(rims), cluster_(soup.points.size()), members_(soup.points.size()) {
  std::iota(cluster_.begin(), cluster_.end(), 0);
  for (const std::uint32_t corner : rims.corners) members_[corner] = {corner};
  first_triangle_.assign(soup.points.size() + 1, 0);
  for (const IndexTriangle& t : rims.triangles) {
    for (const std::uint32_t p : t) ++first_triangle_[p + 1];
  }
  std::partial_sum(first_triangle_.begin(), first_triangle_.end(), first_triangle_.begin());
  triangle_of_.resize(first_triangle_.back());
  std::vector<std::uint32_t> next(first_triangle_.begin(), first_triangle_.end() - 1);
  for (std::uint32_t t = 0; t < rims.triangles.size(); ++t) {
    for (const std::uint32_t p : rims.triangles[t]) triangle_of_[next[p]++] = t;
  }
}

bool CornerClusters::join(double distance, double share, CancelCheck& check) {
  const std::optional<std::vector<Pair>> pairs = pairs_within(distance, share, check);
  if (!pairs) return false;
  const double narrow = std::isinf(share) ? distance : 0;
  for (const Pair& pair : *pairs) {
    check.tick();
    std::uint32_t a = cluster_[pair.a], b = cluster_[pair.b];
    if (a > b) std::swap(a, b);
    if (a == b || !may_join(a, b, 2 * distance, narrow)) continue;
    for (const std::uint32_t corner : members_[b]) cluster_[corner] = a;
    members_[a].insert(members_[a].end(), members_[b].begin(), members_[b].end());
    members_[b].clear();
    joined_.push_back(pair);
  }
  return true;
}

std::optional<std::vector<CornerClusters::Pair>> CornerClusters::pairs_within(
    double distance, double share, CancelCheck& check) const {
  std::vector<Box> boxes(rims_.corners.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i].add(soup_.points[rims_.corners[i]]);
  const BoxTree tree(boxes);
  const auto add_pairs_of = [&](std::size_t i, std::vector<Pair>& pairs) {
    const std::uint32_t a = rims_.corners[i];
    const double reach = std::min(distance, share * rims_.size[a]);
    Box around = boxes[i];
    around.widen(reach);
    tree.visit([&](const Box& box) { return box.meets(around); },
               [&](std::uint32_t k) {
                 const std::uint32_t b = rims_.corners[k];
                 if (b <= a) return;
                 const double squared = (soup_.points[b] - soup_.points[a]).squaredNorm();
                 const double least = std::min(reach, share * rims_.size[b]);
                 if (squared > least * least) return;
                 pairs.push_back({squared, a, b});
               });
  };
  std::vector<Pair> pairs;
  const std::size_t most = kMostNear * boxes.size();
  std::atomic<std::size_t> found = 0;  // by all threads: too many are not even listed
  for (std::size_t begin = 0; begin < boxes.size(); begin += kSearchesAtATime) {
    check.ask();
    const auto pairs_of = [&](std::size_t first, std::size_t last) {
      std::vector<Pair> some;
      for (std::size_t i = begin + first; i < begin + last && found <= most; ++i) {
        const std::size_t before = some.size();
        add_pairs_of(i, some);
        found += some.size() - before;
      }
      return some;
    };
    parallel_reduce(std::min(kSearchesAtATime, boxes.size() - begin), kSearchesPerTask, pairs_of,
                    [&](std::vector<Pair>&, const std::vector<Pair>& some) {
                      pairs.insert(pairs.end(), some.begin(), some.end());
                    });
  }
  if (found > most) return std::nullopt;
  parallel_sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) {
    return std::tie(x.squared_distance, x.a, x.b) < std::tie(y.squared_distance, y.a, y.b);
  });
  return pairs;
}

bool CornerClusters::may_join(std::uint32_t a, std::uint32_t b, double width, double narrow) const {
  for (const std::uint32_t p : members_[a]) {
    for (const std::uint32_t q : members_[b]) {
      const double apart = (soup_.points[p] - soup_.points[q]).norm();
      if (apart > width || (apart > narrow && share_a_triangle(p, q))) return false;
    }
  }
  return true;
}

bool CornerClusters::share_a_triangle(std::uint32_t a, std::uint32_t b) const {
  for (std::uint32_t i = first_triangle_[a]; i < first_triangle_[a + 1]; ++i) {
    const IndexTriangle& t = rims_.triangles[triangle_of_[i]];
    if (t[0] == b || t[1] == b || t[2] == b) return true;
  }
  return false;
}

double CornerClusters::widest_gap() const {
  double squared = 0;
  for (const Pair& pair : joined_) {
    if (cluster_[pair.a] == cluster_[pair.b]) squared = std::max(squared, pair.squared_distance);
  }
  return std::sqrt(squared);
}

void CornerClusters::dissolve(const std::vector<char>& is_dissolved) {
  for (const std::uint32_t corner : rims_.corners) {
    const std::uint32_t cluster = cluster_[corner];
    if (cluster == corner || is_dissolved[cluster] == 0) continue;
    cluster_[corner] = corner;
    members_[corner] = {corner};
  }
  for (const std::uint32_t corner : rims_.corners) {
    if (is_dissolved[corner] != 0) members_[corner] = {corner};
  }
}

std::vector<Vec3d> CornerClusters::middles() const {
  std::vector<Vec3d> middles = soup_.points;
  for (const std::uint32_t corner : rims_.corners) {
    if (members_[corner].size() < 2) continue;
    std::vector<Vec3d> places;
    for (const std::uint32_t member : members_[corner]) places.push_back(soup_.points[member]);
    // The sum is the same in whatever order the soup has them.
    std::sort(places.begin(), places.end(), [](const Vec3d& p, const Vec3d& q) {
      return std::tuple(p.x(), p.y(), p.z()) < std::tuple(q.x(), q.y(), q.z());
    });
    Vec3d sum = Vec3d::Zero();
    for (const Vec3d& place : places) sum += place;
    for (const std::uint32_t member : members_[corner]) {
      middles[member] = sum / static_cast<double>(places.size());
    }
  }
  return middles;
}

}  // namespace meshrepair::internal
