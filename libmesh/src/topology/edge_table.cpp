// SPDX-License-Identifier: MIT
// Sides are put into buckets by the lower end of their edges, some thousand ends to each; in one
// bucket they are counted by that end, of which each has three on average, and those of one are
// sorted by the other end.
#include <algorithm>
#include <cstddef>

#include <base/buckets.h>
#include <base/ids.h>
#include <base/parallel.h>
#include <mesh/edge_table.h>
#include <mesh/mesh_limits.h>

namespace meshrepair {
namespace {

struct Entry {
  std::uint32_t low, high;
  std::uint32_t side;
};

bool comes_first(const Entry& a, const Entry& b) {
  return a.high != b.high ? a.high < b.high : a.side < b.side;
}

std::size_t points_of(std::span<const IndexTriangle> triangles) {
  constexpr std::size_t kTrianglesPerTask = 65536;
  const auto points_in = [&](std::size_t first, std::size_t last) {
    std::size_t points = 0;
    for (const IndexTriangle& t : triangles.subspan(first, last - first)) {
      for (const std::uint32_t p : t) points = std::max<std::size_t>(points, std::size_t{p} + 1);
    }
    return points;
  };
  return parallel_reduce(triangles.size(), kTrianglesPerTask, points_in,
                         [](std::size_t& all, std::size_t part) { all = std::max(all, part); });
}

// Most are so short that comparing neighbours is fastest.
void sort_ends(Entry* first, Entry* last) {
  constexpr std::ptrdiff_t kShort = 16;
  if (last - first > kShort) return std::sort(first, last, comes_first);
  for (Entry* i = first; i < last; ++i) {
    const Entry entry = *i;
    Entry* at = i;
    for (; at > first && comes_first(entry, *(at - 1)); --at) *at = *(at - 1);
    *at = entry;
  }
}

// By all three numbers; those of `low` are in `ends`, from the first one.
void sort_bucket(std::span<Entry> bucket, std::uint32_t first_low, std::size_t ends) {
  std::vector<std::uint32_t> end(ends + 1, 0);  // behind the counting: where each one's end
  for (const Entry& entry : bucket) ++end[entry.low - first_low + 1];
  for (std::size_t p = 0; p < ends; ++p) end[p + 1] += end[p];
  std::vector<Entry> sorted(bucket.size());
  for (const Entry& entry : bucket) sorted[end[entry.low - first_low]++] = entry;
  std::uint32_t begin = 0;
  for (std::size_t p = 0; p < ends; ++p) {
    sort_ends(sorted.data() + begin, sorted.data() + end[p]);
    begin = end[p];
  }
  std::copy(sorted.begin(), sorted.end(), bucket.begin());
}

bool begins_edge(std::span<const Entry> bucket, std::size_t i) {
  return i == 0 || bucket[i].high != bucket[i - 1].high || bucket[i].low != bucket[i - 1].low;
}

}  // namespace

EdgeTable::EdgeTable(std::span<const IndexTriangle> triangles,
                     std::span<const std::uint32_t> across) {
  constexpr std::size_t kMostBuckets = 512, kFewestEnds = 4096;
  require_triangles(triangles.size());
  const std::size_t points = points_of(triangles);
  const std::size_t ends = std::max(kFewestEnds, tasks_of(points, kMostBuckets));
  Buckets<Entry> buckets(
      triangles.size(), tasks_of(points, ends), [&](std::size_t t, const auto& put) {
        for (std::size_t k = 0; k < 3; ++k) {
          const auto side = static_cast<std::uint32_t>(3 * t + k);
          if (!across.empty() && across[side] != kNone) continue;
          const std::uint32_t a = triangles[t][k], b = triangles[t][k == 2 ? 0 : k + 1];
          const std::uint32_t low = std::min(a, b);
          put(low / ends, {low, std::max(a, b), side});
        }
      });
  sides_.resize(buckets.first(buckets.size()));
  std::vector<std::uint32_t> first_edge(buckets.size() + 1, 0);
  parallel_for(buckets.size(), [&](std::size_t b) {
    const auto bucket = buckets[b];
    sort_bucket(bucket, static_cast<std::uint32_t>(b * ends), ends);
    for (std::size_t i = 0; i < bucket.size(); ++i) {
      sides_[buckets.first(b) + i] = bucket[i].side;
      first_edge[b + 1] += begins_edge(bucket, i) ? 1 : 0;
    }
  });
  for (std::size_t b = 0; b < buckets.size(); ++b) first_edge[b + 1] += first_edge[b];
  first_.resize(first_edge.back() + 1, static_cast<std::uint32_t>(sides_.size()));
  parallel_for(buckets.size(), [&](std::size_t b) {
    std::uint32_t edge = first_edge[b];
    for (std::uint32_t i = 0; i < buckets[b].size(); ++i) {
      if (begins_edge(buckets[b], i)) first_[edge++] = buckets.first(b) + i;
    }
  });
}

}  // namespace meshrepair
