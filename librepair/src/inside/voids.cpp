// SPDX-License-Identifier: MIT
#include "voids.h"

#include <algorithm>
#include <utility>

namespace meshrepair::internal {
namespace {

// Regions of cells: those that `belongs(cell)`, connected through links that are open(link).
struct Regions {
  std::vector<std::uint32_t> of;  // of each cell; kNone where it does not belong
  std::uint32_t count = 0;
};

template <class Belongs, class Open>
Regions find_regions(const CellGraph& graph, ProgressObserver* progress, Belongs belongs,
                     Open open) {
  CancelCheck check(progress);
  Regions regions{std::vector<std::uint32_t>(graph.cells(), kNone), 0};
  std::vector<CellId> queue;
  for (CellId seed(0u); seed.index() < graph.cells(); ++seed.value) {
    if (regions.of[seed.index()] != kNone || !belongs(seed)) continue;
    regions.of[seed.index()] = regions.count;
    queue.assign(1, seed);
    while (!queue.empty()) {
      check.tick();
      const CellId cell = queue.back();
      queue.pop_back();
      for (const std::uint32_t l : graph.links_of(cell)) {
        const Link& link = graph.links()[l];
        const CellId next = other_end(link, cell);
        if (regions.of[next.index()] != kNone || !open(link) || !belongs(next)) continue;
        regions.of[next.index()] = regions.count;
        queue.push_back(next);
      }
    }
    ++regions.count;
  }
  return regions;
}

}  // namespace

std::size_t fill_voids(const CellGraph& graph, std::vector<char>& solid,
                       ProgressObserver* progress) {
  // A chamber whose walls cancelled each other has none.
  const Regions regions = find_regions(
      graph, progress,
      [&](CellId c) { return solid[c.index()] == 0 && !graph.links_of(c).empty(); },
      [](const Link&) { return true; });
  std::vector<char> sealed(regions.count, 1);
  for (CellId c(0u); c.index() < graph.cells(); ++c.value) {
    if (graph.unbounded(c) && regions.of[c.index()] != kNone) sealed[regions.of[c.index()]] = 0;
  }
  for (CellId c(0u); c.index() < graph.cells(); ++c.value) {
    const std::uint32_t region = regions.of[c.index()];
    if (region != kNone && sealed[region] != 0) solid[c.index()] = 1;
  }
  return static_cast<std::size_t>(std::count(sealed.begin(), sealed.end(), 1));
}

Voids find_voids(const CellGraph& graph, const std::vector<char>& inside,
                 const std::vector<char>& empty, const IdVector<TriangleId, std::uint32_t>& part_of,
                 ProgressObserver* progress) {
  const Regions regions = find_regions(
      graph, progress, [&](CellId c) { return inside[c.index()] != 0 && empty[c.index()] != 0; },
      [](const Link& link) { return !link.opaque(); });
  std::uint32_t parts = 0;
  for (const std::uint32_t p : part_of) parts = std::max(parts, p + 1);
  // How many links each part has, and once for each of them the region that it borders.
  std::vector<std::size_t> links(parts, 0);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> borders;
  for (const Link& link : graph.links()) {
    if (!link.opaque()) continue;
    const std::uint32_t part = part_of[link.triangle];
    ++links[part];
    const std::uint32_t a = regions.of[link.below.index()];
    const std::uint32_t b = regions.of[link.above.index()];
    if (a != kNone) borders.emplace_back(a, part);
    if (b != kNone && b != a) borders.emplace_back(b, part);
  }
  std::sort(borders.begin(), borders.end());
  std::vector<char> is_void(regions.count, 1);
  for (auto first = borders.begin(); first != borders.end();) {
    const auto last = std::upper_bound(first, borders.end(), *first);
    if (static_cast<std::size_t>(last - first) != links[first->second]) is_void[first->first] = 0;
    first = last;
  }
  Voids voids{std::vector<char>(graph.cells(), 0), 0};
  for (std::size_t i = 0; i < graph.cells(); ++i) {
    voids.marked[i] = regions.of[i] != kNone && is_void[regions.of[i]] != 0;
  }
  voids.count = static_cast<std::size_t>(std::count(is_void.begin(), is_void.end(), 1));
  return voids;
}

}  // namespace meshrepair::internal
