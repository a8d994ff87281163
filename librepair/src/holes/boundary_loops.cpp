// SPDX-License-Identifier: MIT
#include "boundary_loops.h"

#include <algorithm>
#include <utility>

#include <base/disjoint_sets.h>
#include <base/ids.h>

#include "dividers.h"

namespace meshrepair::internal {
namespace {

// Where more border edges meet in a point, any of them will do as the next one.
constexpr std::uint32_t kMostCompared = 32;

std::vector<BorderEdge> find_border(const CleanSoup& soup, std::span<const IndexTriangle> triangles,
                                    const EdgeTable& table) {
  const std::vector<char> is_of_divider = find_dividers(soup, triangles, table);
  std::vector<BorderEdge> border;
  table.for_each_edge([&](std::span<const std::uint32_t> sides) {
    if (sides.size() % 2 == 0) return;
    if (!is_of_divider.empty() && is_of_divider[sides[0]] != 0) return;
    std::int64_t layers = 0;
    for (const std::uint32_t s : sides) layers += soup.triangles[TriangleId(s / 3)].layers;
    if (sides.size() > 1 && layers % 2 == 0) return;
    const std::uint32_t a = side_start(triangles, sides[0]);
    const std::uint32_t b = side_start(triangles, next_side(sides[0]));
    border.push_back({std::min(a, b), std::max(a, b), sides[0], sides.size() == 1});
  });
  return border;
}

// The fans of triangles that the corners of triangles belong to: those that share a point and are
// joined by edges at which two meet. Corner 3 t + k of triangle t is where its side k starts.
DisjointSets join_fans(std::span<const IndexTriangle> triangles, const EdgeTable& table) {
  DisjointSets fans(3 * triangles.size());
  table.for_each_edge([&](std::span<const std::uint32_t> sides) {
    if (sides.size() != 2) return;
    std::uint32_t start = sides[1], end = next_side(sides[1]);
    if (side_start(triangles, start) != side_start(triangles, sides[0])) std::swap(start, end);
    fans.join(sides[0], start);
    fans.join(next_side(sides[0]), end);
  });
  return fans;
}

class LoopWalker {
 public:
  LoopWalker(const CleanSoup& soup, std::span<const IndexTriangle> triangles,
             const EdgeTable& table, std::vector<BorderEdge> border, ProgressObserver* progress)
      : soup_(soup),
        triangles_(triangles),
        check_(progress),
        fans_(join_fans(triangles, table)),
        used_(border.size(), 0),
        first_(soup.points.size() + 1, 0),
        place_(soup.points.size(), kNone) {
    loops_.edges = std::move(border);
    list_edges_at_points();
  }

  BoundaryLoops run() {
    for (std::uint32_t e = 0; e < loops_.edges.size(); ++e) {
      if (used_[e] == 0) walk_from(loops_.edges[e].low);
    }
    return std::move(loops_);
  }

 private:
  void list_edges_at_points() {
    for (const BorderEdge& e : loops_.edges) {
      ++first_[e.low + 1];
      ++first_[e.high + 1];
    }
    for (std::size_t p = 1; p < first_.size(); ++p) first_[p] += first_[p - 1];
    at_point_.resize(2 * loops_.edges.size());
    free_.assign(first_.begin(), first_.end() - 1);
    for (std::uint32_t e = 0; e < loops_.edges.size(); ++e) {
      at_point_[free_[loops_.edges[e].low]++] = e;
      at_point_[free_[loops_.edges[e].high]++] = e;
    }
    free_.assign(first_.begin(), first_.end() - 1);
  }

  // Goes on until there is no way on, and cuts off a loop whenever a point is met again.
  void walk_from(std::uint32_t start) {
    path_.assign(1, {start, kNone});
    place_[start] = 0;
    while (!path_.empty()) {
      check_.tick();
      const std::uint32_t e = next_edge();
      if (e == kNone) {
        loops_.stray_edges += path_.back().edge != kNone;
        place_[path_.back().point] = kNone;
        path_.pop_back();
        continue;
      }
      used_[e] = 1;
      const std::uint32_t p = other_end(e, path_.back().point);
      if (place_[p] != kNone) {
        cut_off_loop(place_[p], e);
      } else {
        place_[p] = static_cast<std::uint32_t>(path_.size());
        path_.push_back({p, e});
      }
    }
  }

  // Where several loops touch: the one that turns back most sharply, around the gap between two
  // fans of triangles. Across a fan only where there is no other way.
  std::uint32_t next_edge() {
    const std::uint32_t at = path_.back().point;
    const std::uint32_t end = first_[at + 1];
    std::uint32_t& free = free_[at];
    while (free < end && used_[at_point_[free]] != 0) ++free;
    if (free == end) return kNone;
    std::uint32_t best = at_point_[free];
    if (path_.back().edge == kNone || free + 1 == end) return best;
    const Vec3d back = direction(at, path_[path_.size() - 2].point);
    const std::uint32_t fan = fan_at(path_.back().edge, at);
    const auto rank = [&](std::uint32_t e) {
      return std::pair(fan_at(e, at) != fan, back.dot(direction(at, other_end(e, at))));
    };
    auto best_rank = rank(best);
    for (std::uint32_t i = free + 1; i < std::min(end, free + kMostCompared); ++i) {
      if (used_[at_point_[i]] != 0) continue;
      const auto next = rank(at_point_[i]);
      if (next <= best_rank) continue;
      best_rank = next;
      best = at_point_[i];
    }
    return best;
  }

  // The fan that ends in this edge.
  [[nodiscard]] std::uint32_t fan_at(std::uint32_t e, std::uint32_t point) {
    const std::uint32_t side = loops_.edges[e].side;
    return fans_.root(side_start(triangles_, side) == point ? side : next_side(side));
  }

  void cut_off_loop(std::uint32_t from, std::uint32_t closing_edge) {
    const std::size_t n = path_.size() - from;
    const auto point = [&](std::size_t i) { return path_[from + i % n].point; };
    const auto edge = [&](std::size_t i) {
      return (i + 1) % n == 0 ? closing_edge : path_[from + i % n + 1].edge;
    };
    for (std::size_t i = from + 1; i < path_.size(); ++i) place_[path_[i].point] = kNone;
    bool open = false;
    for (std::size_t i = 0; i < n; ++i) open |= loops_.edges[edge(i)].open;
    if (open) add_loop(n, point, edge);
    path_.resize(from + 1);
  }

  // Of n points and edges, from where it starts.
  template <class At, class EdgeAt>
  void add_loop(std::size_t n, At point, EdgeAt edge) {
    std::size_t low = 0;
    for (std::size_t i = 1; i < n; ++i) {
      if (point(i) < point(low)) low = i;
    }
    const bool forward = point(low + 1) < point(low + n - 1);
    for (std::size_t i = 0; i < n; ++i) {
      loops_.point.push_back(point(forward ? low + i : low + n - i));
      loops_.edge.push_back(edge(forward ? low + i : low + n - i - 1));
    }
    loops_.first.push_back(loops_.point.size());
  }

  [[nodiscard]] std::uint32_t other_end(std::uint32_t e, std::uint32_t point) const {
    const BorderEdge& edge = loops_.edges[e];
    return edge.low == point ? edge.high : edge.low;
  }

  [[nodiscard]] Vec3d direction(std::uint32_t from, std::uint32_t to) const {
    const GridPoint& a = soup_.grid_points[PointId(from)];
    const GridPoint& b = soup_.grid_points[PointId(to)];
    return Vec3d(b.x - a.x, b.y - a.y, b.z - a.z).normalized();
  }

  struct Step {
    std::uint32_t point;
    std::uint32_t edge;  // that led here
  };

  const CleanSoup& soup_;
  std::span<const IndexTriangle> triangles_;
  CancelCheck check_;
  BoundaryLoops loops_;
  DisjointSets fans_;
  std::vector<char> used_;               // of each edge
  std::vector<std::uint32_t> first_;     // the edges at point p are at_point_[first_[p]] ...
  std::vector<std::uint32_t> at_point_;  // ... to at_point_[first_[p + 1] - 1]
  std::vector<std::uint32_t> free_;      // those of p before free_[p] are used
  std::vector<std::uint32_t> place_;     // of each point on the path
  std::vector<Step> path_;
};

}  // namespace

BoundaryLoops find_boundary_loops(const CleanSoup& soup, std::span<const IndexTriangle> triangles,
                                  const EdgeTable& table, ProgressObserver* progress) {
  return walk_border(soup, triangles, table, find_border(soup, triangles, table), progress);
}

BoundaryLoops walk_border(const CleanSoup& soup, std::span<const IndexTriangle> triangles,
                          const EdgeTable& table, std::vector<BorderEdge> border,
                          ProgressObserver* progress) {
  if (border.empty()) return {};
  return LoopWalker(soup, triangles, table, std::move(border), progress).run();
}

void append_loops(BoundaryLoops& loops, const BoundaryLoops& more) {
  const std::size_t points = loops.point.size(), edges = loops.edges.size();
  loops.edges.insert(loops.edges.end(), more.edges.begin(), more.edges.end());
  loops.point.insert(loops.point.end(), more.point.begin(), more.point.end());
  for (const std::uint32_t e : more.edge)
    loops.edge.push_back(static_cast<std::uint32_t>(edges + e));
  for (std::size_t l = 0; l < more.loops(); ++l) loops.first.push_back(points + more.first[l + 1]);
}

}  // namespace meshrepair::internal
