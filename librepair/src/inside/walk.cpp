// SPDX-License-Identifier: MIT
#include <base/parallel.h>
#include <repair/walk.h>

namespace meshrepair {
namespace {

// A millisecond of work.
constexpr std::size_t kLinksPerTask = 65536;

// step(link, from, value of from) is the value at the link's other end.
template <class Step>
Walk walk(const CellGraph& graph, ProgressObserver* progress, Step step) {
  CancelCheck check(progress);
  Walk result;
  result.value.assign(graph.cells(), 0);
  std::vector<char> reached(graph.cells(), 0);
  std::vector<CellId> queue;
  for (CellId c(0u); c.index() < graph.cells(); ++c.value) {
    if (!graph.unbounded(c)) continue;
    reached[c.index()] = 1;
    queue.push_back(c);
  }
  for (std::size_t i = 0; i < queue.size(); ++i) {
    check.tick();
    const CellId cell = queue[i];
    for (const std::uint32_t l : graph.links_of(cell)) {
      const Link& link = graph.links()[l];
      const CellId next = other_end(link, cell);
      if (reached[next.index()] != 0) continue;
      reached[next.index()] = 1;
      result.value[next.index()] = step(link, cell, result.value[cell.index()]);
      queue.push_back(next);
    }
  }
  const auto contradictions = [&](std::size_t first, std::size_t last) {
    std::size_t count = 0;
    for (std::size_t l = first; l < last; ++l) {
      const Link& link = graph.links()[l];
      const std::int32_t expected = step(link, link.above, result.value[link.above.index()]);
      count += expected != result.value[link.below.index()];
    }
    return count;
  };
  result.contradictions = parallel_reduce(graph.links().size(), kLinksPerTask, contradictions,
                                          [](std::size_t& all, std::size_t part) { all += part; });
  return result;
}

}  // namespace

Walk walk_parity(const CellGraph& graph, ProgressObserver* progress) {
  return walk(graph, progress, [](const Link& link, CellId, std::int32_t value) {
    return link.opaque() ? 1 - value : value;
  });
}

Walk walk_winding(const CellGraph& graph, ProgressObserver* progress) {
  return walk(graph, progress, [](const Link& link, CellId from, std::int32_t value) {
    return from == link.above ? value + link.winding : value - link.winding;
  });
}

}  // namespace meshrepair
