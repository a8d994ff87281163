#include "fill_sealed.h"

#include <cstdint>
#include <utility>

#include <base/ids.h>

namespace meshrepair::internal {
namespace {

constexpr char kOutside = 1, kBehind = 2;

class SealedSpaces {
 public:
  SealedSpaces(const CellGraph& graph, TriangleId first_seal, const std::vector<char>& solid,
               ProgressObserver* progress)
      : graph_(graph),
        first_seal_(first_seal),
        solid_(solid),
        check_(progress),
        marks_(graph.cells(), 0) {}

  void find() {
    std::vector<CellId> outside;
    for (CellId c(0u); c.index() < graph_.cells(); ++c.value) {
      if (graph_.unbounded(c)) outside.push_back(c);
    }
    spread(std::move(outside), kOutside);
    for (const Link& link : graph_.links()) {
      if (!is_seal(link)) continue;
      const bool is_below = marks_[link.below.index()] == kOutside;
      const CellId behind = is_below ? link.above : link.below;
      const bool leads_in = is_below != (marks_[link.above.index()] == kOutside);
      if (!leads_in || marks_[behind.index()] != 0 || solid_[behind.index()] != 0) continue;
      spread({behind}, kBehind);
    }
  }

  [[nodiscard]] bool is_behind(CellId cell) const { return marks_[cell.index()] == kBehind; }

 private:
  [[nodiscard]] bool is_seal(const Link& link) const {
    return link.opaque() && link.triangle.value >= first_seal_.value;
  }

  // From these empty cells past no triangle; what is behind a seal goes on past others.
  void spread(std::vector<CellId> waiting, char mark) {
    for (const CellId cell : waiting) marks_[cell.index()] = mark;
    while (!waiting.empty()) {
      check_.tick();
      const CellId cell = waiting.back();
      waiting.pop_back();
      for (const std::uint32_t l : graph_.links_of(cell)) {
        const Link& link = graph_.links()[l];
        const std::size_t next = other_end(link, cell).index();
        const bool passes = !link.opaque() || (mark == kBehind && is_seal(link));
        if (!passes || marks_[next] != 0 || solid_[next] != 0) continue;
        marks_[next] = mark;
        waiting.push_back(other_end(link, cell));
      }
    }
  }

  const CellGraph& graph_;
  TriangleId first_seal_;
  const std::vector<char>& solid_;
  CancelCheck check_;
  std::vector<char> marks_;  // of each cell
};

}  // namespace

void fill_sealed(const CellGraph& graph, const CleanSoup& soup, const RepairOptions& options,
                 RepairReport& report, std::vector<char>& solid) {
  if (report.seal.triangles == 0) return;
  const TriangleId first(soup.triangles.size() - report.seal.triangles);
  SealedSpaces spaces(graph, first, solid, options.progress);
  spaces.find();
  double volume = 0;
  for (CellId c(0u); c.index() < graph.cells(); ++c.value) {
    if (!spaces.is_behind(c)) continue;
    solid[c.index()] = 1;
    volume += graph.volume(c);
  }
  const double unit = soup.grid.unit;
  report.seal.filled_volume = volume * unit * unit * unit;
}

}  // namespace meshrepair::internal
