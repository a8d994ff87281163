// SPDX-License-Identifier: MIT
// A line sweeps over the edges, as in Shamos and Hoey, Geometric intersection problems (1976): two
// edges can cross only where they are next to each other on it, and it ends at the first that do.
// Going up the line, edges enter the region and leave it by turns.
#include "simple_outline.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <set>
#include <tuple>
#include <vector>

#include <exact/double_predicates.h>

namespace meshrepair::internal {
namespace {

class OutlineSweep {
 public:
  OutlineSweep(std::span<const OutlineEdge> edges, int axis, int turn)
      : axis_(axis), u_((axis + 1) % 3), v_((axis + 2) % 3), line_(Order{this}) {
    edges_.reserve(edges.size());
    ends_.reserve(2 * edges.size());
    for (const OutlineEdge& e : edges) {
      const bool goes_right = place(*e.from_at) < place(*e.to_at);
      const auto id = static_cast<std::uint32_t>(edges_.size());
      edges_.push_back(goes_right ? Edge{e.from_at, e.to_at, e.to, turn > 0}
                                  : Edge{e.to_at, e.from_at, e.from, turn < 0});
      ends_.push_back({*e.from_at, e.from, id, !goes_right});
      ends_.push_back({*e.to_at, e.to, id, goes_right});
    }
  }

  [[nodiscard]] bool run() {
    std::sort(ends_.begin(), ends_.end(), [&](const End& a, const End& b) {
      return std::tuple(place(a.at), a.corner, !a.is_right, a.edge) <
             std::tuple(place(b.at), b.corner, !b.is_right, b.edge);
    });
    for (std::size_t first = 0, last = 0; first < ends_.size(); first = last) {
      while (last < ends_.size() && ends_[last].corner == ends_[first].corner &&
             place(ends_[last].at) == place(ends_[first].at)) {
        ++last;
      }
      const bool is_alone = first == 0 || place(ends_[first - 1].at) < place(ends_[first].at);
      if (!is_alone || !pass(std::span(ends_).subspan(first, last - first))) return false;
    }
    return true;
  }

 private:
  // From left to right, and upwards where two ends are on one vertical line: as if it were tilted.
  struct Edge {
    const Vec3d* left;
    const Vec3d* right;
    std::uint32_t right_corner;
    bool enters;  // the region is above
  };
  struct End {
    Vec3d at;
    std::uint32_t corner;
    std::uint32_t edge;
    bool is_right;
  };
  // Of edges that the line meets, from the lowest; and of a point on it among them.
  struct Order {
    using is_transparent = void;
    const OutlineSweep* sweep;

    bool operator()(std::uint32_t a, std::uint32_t b) const { return sweep->is_below(a, b); }
    bool operator()(std::uint32_t edge, const End& point) const {
      return sweep->side(edge, point) > 0;
    }
  };
  using Line = std::set<std::uint32_t, Order>;

  [[nodiscard]] std::pair<double, double> place(const Vec3d& point) const {
    return {point[u_], point[v_]};
  }

  // 1: above the edge.
  [[nodiscard]] int side(std::uint32_t edge, const Vec3d& point) const {
    return orientation_along(axis_, *edges_[edge].left, *edges_[edge].right, point);
  }
  [[nodiscard]] int side(std::uint32_t edge, const End& point) const {
    return edges_[edge].right_corner == point.corner ? 0 : side(edge, point.at);
  }

  // Where the later of the two begins.
  [[nodiscard]] bool is_below(std::uint32_t a, std::uint32_t b) const {
    if (a == b) return false;
    const auto from_a = place(*edges_[a].left), from_b = place(*edges_[b].left);
    if (from_a == from_b) return side(a, *edges_[b].right) > 0;
    return from_a < from_b ? side(a, *edges_[b].left) > 0 : side(b, *edges_[a].left) < 0;
  }

  // Do they meet to the right of the line, but where both end?
  [[nodiscard]] bool cross(std::uint32_t below, std::uint32_t above) const {
    const Edge &a = edges_[below], &b = edges_[above];
    if (a.right_corner == b.right_corner) return false;
    return place(*a.right) < place(*b.right) ? side(above, *a.right) >= 0
                                             : side(below, *b.right) <= 0;
  }

  // The ends at one corner, right ones first.
  [[nodiscard]] bool pass(std::span<const End> ends) {
    const auto begins =
        std::partition_point(ends.begin(), ends.end(), [](const End& end) { return end.is_right; });
    auto next = line_.lower_bound(ends.front());
    for (auto end = ends.begin(); end != begins; ++end) {
      if (next == line_.end() || edges_[*next].right_corner != end->corner) return false;
      next = line_.erase(next);
    }
    if (next != line_.end() && side(*next, ends.front()) == 0) return false;
    return insert({begins, ends.end()}, next);
  }

  // The edges that begin at one corner, below `next`.
  [[nodiscard]] bool insert(std::span<const End> ends, Line::iterator next) {
    starting_.clear();
    for (const End& end : ends) starting_.push_back(end.edge);
    std::sort(starting_.begin(), starting_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return side(a, *edges_[b].right) > 0; });
    const bool has_below = next != line_.begin(), has_above = next != line_.end();
    std::uint32_t below = has_below ? *std::prev(next) : 0;
    bool is_first = !has_below;
    bool inside = has_below && edges_[below].enters;
    const auto follows = [&](std::uint32_t edge) {
      if (edges_[edge].enters == inside || (!is_first && cross(below, edge))) return false;
      inside = !inside;
      is_first = false;
      below = edge;
      return true;
    };
    for (std::size_t i = 0; i < starting_.size(); ++i) {
      if (i > 0 && side(starting_[i - 1], *edges_[starting_[i]].right) == 0) return false;
      if (!follows(starting_[i])) return false;
    }
    if (has_above ? !follows(*next) : inside) return false;
    for (const std::uint32_t edge : starting_) line_.insert(next, edge);
    return true;
  }

  int axis_;
  Eigen::Index u_, v_;
  std::vector<Edge> edges_;
  std::vector<End> ends_;
  std::vector<std::uint32_t> starting_;  // scratch
  Line line_;
};

}  // namespace

bool is_simple_outline(std::span<const OutlineEdge> edges, int axis, int turn) {
  return OutlineSweep(edges, axis, turn).run();
}

}  // namespace meshrepair::internal
