#include <algorithm>

#include <mesh/edge_table.h>

namespace meshrepair {

EdgeTable::EdgeTable(std::span<const IndexTriangle> triangles) {
  struct Entry {
    std::uint64_t key;
    std::uint32_t side;
  };
  std::vector<Entry> entries;
  entries.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangles[t][k];
      const std::uint32_t b = triangles[t][(k + 1) % 3];
      const std::uint64_t key = (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
      entries.push_back({key, static_cast<std::uint32_t>(3 * t + k)});
    }
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.key != b.key ? a.key < b.key : a.side < b.side;
  });
  sides_.reserve(entries.size());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (i == 0 || entries[i].key != entries[i - 1].key) {
      first_.push_back(static_cast<std::uint32_t>(i));
    }
    sides_.push_back(entries[i].side);
  }
  first_.push_back(static_cast<std::uint32_t>(entries.size()));
}

}  // namespace meshrepair
