// Sides are counted by the lower end of their edges and put into one bucket for each; within a
// bucket, which has three on average, they are sorted by the other end.
#include <algorithm>
#include <cstddef>

#include <base/ids.h>
#include <mesh/edge_table.h>

namespace meshrepair {
namespace {

struct Entry {
  std::uint32_t high;
  std::uint32_t side;
};

bool comes_first(const Entry& a, const Entry& b) {
  return a.high != b.high ? a.high < b.high : a.side < b.side;
}

std::size_t points_of(std::span<const IndexTriangle> triangles) {
  std::size_t points = 0;
  for (const IndexTriangle& t : triangles) {
    for (const std::uint32_t p : t) points = std::max<std::size_t>(points, std::size_t{p} + 1);
  }
  return points;
}

// Most are so short that comparing neighbours is fastest.
void sort_bucket(Entry* first, Entry* last) {
  constexpr std::ptrdiff_t kShort = 16;
  if (last - first > kShort) return std::sort(first, last, comes_first);
  for (Entry* i = first; i < last; ++i) {
    const Entry entry = *i;
    Entry* at = i;
    for (; at > first && comes_first(entry, *(at - 1)); --at) *at = *(at - 1);
    *at = entry;
  }
}

}  // namespace

EdgeTable::EdgeTable(std::span<const IndexTriangle> triangles,
                     std::span<const std::uint32_t> across) {
  const std::size_t points = points_of(triangles);
  const auto for_each_side = [&](auto visit) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        if (!across.empty() && across[3 * t + k] != kNone) continue;
        const std::uint32_t a = triangles[t][k], b = triangles[t][k == 2 ? 0 : k + 1];
        visit(std::min(a, b), Entry{std::max(a, b), 3 * t + k});
      }
    }
  };
  // Behind the counting: where the bucket of each point ends.
  std::vector<std::uint32_t> end(points + 1, 0);
  for_each_side([&](std::uint32_t low, const Entry&) { ++end[low + 1]; });
  for (std::size_t p = 0; p < points; ++p) end[p + 1] += end[p];
  std::vector<Entry> entries(end[points]);
  for_each_side([&](std::uint32_t low, const Entry& entry) { entries[end[low]++] = entry; });
  sides_.resize(entries.size());
  std::uint32_t begin = 0;
  for (std::size_t p = 0; p < points; ++p) {
    sort_bucket(entries.data() + begin, entries.data() + end[p]);
    for (std::uint32_t i = begin; i < end[p]; ++i) {
      if (i == begin || entries[i].high != entries[i - 1].high) first_.push_back(i);
      sides_[i] = entries[i].side;
    }
    begin = end[p];
  }
  first_.push_back(static_cast<std::uint32_t>(entries.size()));
}

}  // namespace meshrepair
