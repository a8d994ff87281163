// SPDX-License-Identifier: MIT
#include "chamber_solids.h"

#include <algorithm>
#include <utility>

#include <repair/chamber_graph.h>
#include <repair/inside_rule.h>

namespace meshrepair::internal {
namespace {

// Of one chamber: the solids with their winding numbers, which are not 0, ascending.
using Windings = std::vector<SolidWinding>;

class ChamberWalk {
 public:
  ChamberWalk(const Arrangement& arrangement, const JoinedSolids& joined)
      : joined_(joined),
        walls_(arrangement.walls()),
        layers_(arrangement.layers()),
        windings_(arrangement.chambers()),
        is_known_(arrangement.chambers(), 0) {
    std::sort(layers_.begin(), layers_.end(),
              [](const auto& a, const auto& b) { return a.wall < b.wall; });
    list_walls();
  }

  // False where windings contradict each other.
  bool run() {
    is_known_[Arrangement::kOutside] = 1;
    std::vector<std::uint32_t> waiting = {Arrangement::kOutside};
    while (!waiting.empty()) {
      const std::uint32_t chamber = waiting.back();
      waiting.pop_back();
      for (std::uint32_t i = first_[chamber]; i < first_[chamber + 1]; ++i) {
        const std::uint32_t wall = of_chamber_[i];
        const std::uint32_t other =
            walls_[wall].below == chamber ? walls_[wall].above : walls_[wall].below;
        pass(wall, chamber);
        if (is_known_[other] != 0) {
          if (passed_ != windings_[other]) return false;
          continue;
        }
        is_known_[other] = 1;
        windings_[other] = passed_;
        waiting.push_back(other);
      }
    }
    return windings_[Arrangement::kOutside].empty();
  }

  [[nodiscard]] std::vector<std::vector<std::uint32_t>> solids() const {
    std::vector<std::vector<std::uint32_t>> solids(windings_.size());
    for (std::size_t c = 0; c < solids.size(); ++c) {
      for (const SolidWinding& one : windings_[c]) solids[c].push_back(one.solid);
    }
    return solids;
  }

 private:
  void list_walls() {
    first_.assign(windings_.size() + 1, 0);
    for (const ChamberWall& wall : walls_) {
      ++first_[wall.below + 1];
      ++first_[wall.above + 1];
    }
    for (std::size_t c = 0; c + 1 < first_.size(); ++c) first_[c + 1] += first_[c];
    of_chamber_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t w = 0; w < walls_.size(); ++w) {
      of_chamber_[next[walls_[w].below]++] = w;
      of_chamber_[next[walls_[w].above]++] = w;
    }
  }

  // `passed_` gets the windings on the other side of a wall of the chamber. What is turned along
  // the normal has its inside below.
  void pass(std::uint32_t wall, std::uint32_t chamber) {
    const std::int32_t sign = walls_[wall].above == chamber ? 1 : -1;
    passed_ = windings_[chamber];
    add(walls_[wall].triangle, sign);
    auto layer = std::lower_bound(layers_.begin(), layers_.end(), wall,
                                  [](const auto& l, std::uint32_t w) { return l.wall < w; });
    for (; layer != layers_.end() && layer->wall == wall; ++layer) add(layer->triangle, sign);
  }

  void add(std::uint32_t triangle, std::int32_t sign) {
    for (const SolidWinding& one : joined_.of(TriangleId(triangle))) {
      const auto at =
          std::lower_bound(passed_.begin(), passed_.end(), one.solid,
                           [](const SolidWinding& w, std::uint32_t s) { return w.solid < s; });
      if (at == passed_.end() || at->solid != one.solid) {
        passed_.insert(at, {one.solid, sign * one.winding});
      } else if ((at->winding += sign * one.winding) == 0) {
        passed_.erase(at);
      }
    }
  }

  const JoinedSolids& joined_;
  std::vector<ChamberWall> walls_;
  std::vector<Arrangement::Layer> layers_;
  std::vector<Windings> windings_;
  std::vector<char> is_known_;
  std::vector<std::uint32_t> first_, of_chamber_;  // walls
  Windings passed_;
};

}  // namespace

std::optional<std::vector<std::vector<std::uint32_t>>> solids_of_chambers(
    const Arrangement& arrangement, const JoinedSolids& joined) {
  ChamberWalk walk(arrangement, joined);
  if (!walk.run()) return std::nullopt;
  return walk.solids();
}

std::vector<std::vector<std::uint32_t>> likely_solids_of_chambers(const Arrangement& arrangement,
                                                                  const JoinedSolids& joined,
                                                                  ProgressObserver* progress) {
  CellGraph graph = graph_of_chambers(arrangement, joined.soup(), joined.orientation());
  InsideOptions inside;
  inside.rule = InsideRule::winding;
  inside.solve.progress = progress;
  std::vector<std::vector<std::uint32_t>> solids(arrangement.chambers());
  for (std::uint32_t k = 0; k < joined.solids(); ++k) {
    graph.set_windings(joined.windings(k));
    InsideReport report;
    const std::vector<char> solid = label_cells(graph, {}, inside, report).solid;
    for (std::size_t c = 0; c < solid.size(); ++c) {
      if (solid[c] != 0) solids[c].push_back(k);
    }
  }
  return solids;
}

}  // namespace meshrepair::internal
