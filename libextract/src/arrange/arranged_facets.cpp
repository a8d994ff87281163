// SPDX-License-Identifier: MIT
// In this order, each step over all triangles at once:
//
//   1  Each pair tells its points and segments.
//   2  Points on an edge are put into order along it; those at one place are joined.
//   3  In each triangle, the segments are compared with each other: three triangles make a point.
//   4  Points on each segment are put into order along it, as in 2.
//   5  Each triangle is triangulated with all its points, and with the parts of its segments as
//      edges.
#include "arranged_facets.h"

#include <algorithm>
#include <atomic>
#include <numeric>

#include <base/parallel.h>
#include <base/release.h>
#include <base/shared_progress.h>

#include "cut_lines.h"
#include "meeting_records.h"
#include "triangulate/planar_mesh.h"

namespace meshrepair::internal {
namespace {

constexpr std::size_t kTrianglesPerTask = 128;

// Items of each of so many keys, in their order.
template <class Item>
struct Grouped {
  std::vector<std::uint32_t> first;
  std::vector<Item> items;

  template <class Record, class Key, class Value>
  void fill(const std::vector<Record>& records, std::size_t keys, Key key, Value value) {
    first.assign(keys + 1, 0);
    for (const Record& r : records) ++first[key(r) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    items.resize(records.size());
    std::vector<std::uint32_t> at(first.begin(), first.end() - 1);
    for (const Record& r : records) items[at[key(r)]++] = value(r);
  }
  [[nodiscard]] std::span<const Item> of(std::size_t key) const {
    return {items.data() + first[key], first[key + 1] - first[key]};
  }
};

using SamePoints = std::vector<std::array<std::uint32_t, 2>>;

// Points of a line in order, each place once.
class PointSorter {
 public:
  PointSorter(const CutSet& cut, const ArrangedPoints& points) : cut_(cut), points_(points) {}

  // Adds to `same` what is at one place.
  void sort(const Direction& direction, std::vector<std::uint32_t>& list, SamePoints& same) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    at_.clear();
    for (const std::uint32_t p : list) at_.push_back(points_.at(p));
    order_.resize(list.size());
    std::iota(order_.begin(), order_.end(), 0u);
    const auto order = [&](std::uint32_t i, std::uint32_t j) {
      return order_along(direction, at_[i], at_[j], cut_.planes());
    };
    std::sort(order_.begin(), order_.end(),
              [&](std::uint32_t i, std::uint32_t j) { return order(i, j) > 0; });
    sorted_.clear();
    for (std::size_t i = 0; i < order_.size(); ++i) {
      if (i > 0 && order(order_[i - 1], order_[i]) == 0) {
        same.push_back({list[order_[i - 1]], list[order_[i]]});
      }
      sorted_.push_back(list[order_[i]]);
    }
    list.swap(sorted_);
  }

 private:
  const CutSet& cut_;
  const ArrangedPoints& points_;
  std::vector<Point> at_;
  std::vector<std::uint32_t> order_, sorted_;
};

// What one triangle becomes; vertices are points, sides are numbered from its own first one.
struct CutTriangle {
  std::vector<IndexTriangle> corners;
  std::vector<std::uint32_t> across;
};

class FacetArranger {
 public:
  FacetArranger(const CutSet& cut, std::optional<ArrangedPoints>& points,
                ProgressObserver* progress)
      : cut_(cut), points_(points), quiet_(progress) {}

  std::optional<ArrangedFacets> run(std::span<const CutSet::Pair> pairs) {
    if (cut_.edges() >= PointName::kMostEdges) return std::nullopt;
    group(record_meetings(cut_, pairs, &quiet_));
    sort_edges();
    if (!find_lines()) return std::nullopt;
    sort_lines();
    points_->settle();
    return triangulate();
  }

 private:
  void group(const MeetingRecords& records) {
    std::vector<PointName> names;
    names.reserve(records.on_edges.size());
    for (const PointOnEdge& p : records.on_edges) names.push_back(p.point);
    points_.emplace(cut_, std::move(names));
    std::vector<std::uint32_t> on_edges(records.on_edges.size());
    parallel_for(on_edges.size(),
                 [&](std::size_t i) { on_edges[i] = points_->find(records.on_edges[i].point); });
    on_edges_.fill(
        records.on_edges, cut_.edges(), [](const PointOnEdge& p) { return p.edge; },
        [&](const PointOnEdge& p) {
          return on_edges[static_cast<std::size_t>(&p - records.on_edges.data())];
        });
    segments_.fill(
        records.segments, cut_.size(), [](const CutSegment& s) { return s.cut; },
        [](const CutSegment& s) { return s; });
    contacts_.fill(
        records.contacts, cut_.size(), [](const Contact& c) { return c.cut; },
        [&](const Contact& c) { return points_->find(c.point); });
  }

  // Calls do_one(number, task) for all numbers below `count`, those of a task in order.
  template <class DoOne>
  void for_all(std::size_t count, DoOne do_one) {
    SharedProgress shared(&quiet_, tasks_of(count, kTrianglesPerTask));
    const auto do_task = [&](std::size_t task, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) do_one(static_cast<std::uint32_t>(i), task);
      shared.done();
    };
    parallel_tasks(count, kTrianglesPerTask, do_task);
  }

  // Its ends are not among them.
  void sort_edges() {
    edge_points_.resize(cut_.edges());
    same_.resize(tasks_of(cut_.edges(), kTrianglesPerTask));
    for_all(cut_.edges(), [&](std::uint32_t e, std::size_t task) {
      const auto points = on_edges_.of(e);
      if (points.empty()) return;
      PointSorter sorter(cut_, *points_);
      edge_points_[e].assign(points.begin(), points.end());
      sorter.sort(direction_of_edge(e), edge_points_[e], same_[task]);
    });
  }

  [[nodiscard]] Direction direction_of_edge(std::uint32_t e) const {
    const GridPoint& a = cut_.soup().grid_points[PointId(cut_.ends(e)[0])];
    const GridPoint& b = cut_.soup().grid_points[PointId(cut_.ends(e)[1])];
    return {Int128{b.x} - a.x, Int128{b.y} - a.y, Int128{b.z} - a.z};
  }

  bool find_lines() {
    lines_.resize(cut_.size());
    std::atomic<bool> sound = true;
    for_all(cut_.size(), [&](std::uint32_t t, std::size_t) {
      lines_[t] = find_cut_lines(cut_, *points_, t, segments_.of(t), contacts_.of(t));
      if (!lines_[t].sound) sound = false;
    });
    if (!sound) return false;
    std::vector<TripleName> triples;
    for (const CutLines& lines : lines_) {
      for (const LinePoint& p : lines.points) {
        if (p.point == kNone) triples.push_back(p.triple);
      }
    }
    points_->add_triples(std::move(triples));
    join(same_);
    for (CutLines& lines : lines_) {
      for (const auto& [a, b] : lines.same) points_->join(a, b);
    }
    return points_->sound();
  }

  void join(const std::vector<SamePoints>& all) {
    for (const SamePoints& same : all) {
      for (const auto& [a, b] : same) points_->join(a, b);
    }
  }

  // From their ends on.
  void sort_lines() {
    line_points_.resize(cut_.size());
    same_.assign(tasks_of(cut_.size(), kTrianglesPerTask), {});
    for_all(cut_.size(), [&](std::uint32_t t, std::size_t task) {
      sort_lines_of(t, same_[task]);
      lines_[t] = {};
    });
    join(same_);
    release(same_);
  }

  void sort_lines_of(std::uint32_t t, SamePoints& same) {
    const CutLines& found = lines_[t];
    std::vector<std::vector<std::uint32_t>>& lists = line_points_[t];
    lists.resize(found.lines.size());
    for (const LinePoint& p : found.points) {
      lists[p.line].push_back(p.point == kNone ? points_->find(p.triple) : p.point);
    }
    PointSorter sorter(cut_, *points_);
    for (std::size_t i = 0; i < lists.size(); ++i) {
      const CutLine& line = found.lines[i];
      lists[i].push_back(line.from);
      lists[i].push_back(line.to);
      if (lists[i].size() == 2) continue;
      sorter.sort(direction_of(cut_.planes()[cut_.plane(t)], cut_.planes()[line.plane]), lists[i],
                  same);
    }
  }

  std::optional<ArrangedFacets> triangulate() {
    std::vector<CutTriangle> all(cut_.size());
    std::atomic<bool> sound = true;
    for_all(cut_.size(), [&](std::uint32_t t, std::size_t) {
      if (!triangulate(t, all[t])) sound = false;
      release(line_points_[t]);
    });
    if (!sound) return std::nullopt;
    for_all(cut_.edges(), [&](std::uint32_t e, std::size_t) { release(edge_points_[e]); });
    return put_together(all);
  }

  // Each one goes as it is taken.
  ArrangedFacets put_together(std::vector<CutTriangle>& all) {
    ArrangedFacets facets;
    facets.first.reserve(all.size() + 1);
    std::uint32_t count = 0;
    for (const CutTriangle& triangle : all) {
      facets.first.push_back(count);
      count += static_cast<std::uint32_t>(triangle.corners.size());
    }
    facets.first.push_back(count);
    facets.corners.resize(count);
    facets.across.resize(3 * std::size_t{count});
    for_all(all.size(), [&](std::uint32_t t, std::size_t) {
      const std::uint32_t first = facets.first[t];
      std::copy(all[t].corners.begin(), all[t].corners.end(),
                facets.corners.begin() + static_cast<std::ptrdiff_t>(first));
      for (std::size_t i = 0; i < all[t].across.size(); ++i) {
        const std::uint32_t s = all[t].across[i];
        facets.across[3 * std::size_t{first} + i] = s == kNone ? kNone : s + 3 * first;
      }
      all[t] = {};
    });
    return facets;
  }

  bool triangulate(std::uint32_t t, CutTriangle& result) const;
  // From corner k to the next one.
  [[nodiscard]] std::vector<std::uint32_t> points_on_side(std::uint32_t t, std::size_t k) const;

  const CutSet& cut_;
  std::optional<ArrangedPoints>& points_;
  CancelOnly quiet_;
  Grouped<std::uint32_t> on_edges_, contacts_;
  Grouped<CutSegment> segments_;
  std::vector<std::vector<std::uint32_t>> edge_points_;
  std::vector<CutLines> lines_;
  std::vector<std::vector<std::vector<std::uint32_t>>> line_points_;
  std::vector<SamePoints> same_;
};

// Puts the points and lines of one triangle into a mesh.
class TriangleFiller {
 public:
  TriangleFiller(const CutSet& cut, const ArrangedPoints& points, std::uint32_t t)
      : cut_(cut), points_(points), triangle_(t), mesh_(cut.planes(), false) {
    mesh_.reset(cut.plane(t), cut.side_of(t));
  }

  void add_corners(std::size_t others) {
    at_.reserve(3 + others);  // they must not move
    for (const std::uint32_t p : cut_.corners(triangle_)) {
      at_.push_back(points_.at(p));
      mesh_.add_vertex(at_.back());
      point_.push_back(p);
    }
    mesh_.add_triangle({0, 1, 2});
    for (std::uint32_t k = 0; k < 3; ++k) mesh_.mark(k, kFixed);
  }

  // In order from corner k to the next one.
  void add_on_side(std::uint32_t k, std::span<const std::uint32_t> points) {
    std::uint32_t vertex = k;
    for (const std::uint32_t p : points) {
      at_.push_back(points_.at(p));
      vertex = mesh_.split_outline(mesh_.outline_from(vertex), at_.back());
      point_.push_back(p);
    }
  }

  // All must be there that are, before the edges.
  bool add_inside(std::span<const std::uint32_t> points) {
    for (const std::uint32_t p : points) {
      std::uint32_t vertex = 0;
      at_.push_back(points_.at(p));
      if (!mesh_.insert_vertex(at_.back(), vertex)) return false;
      point_.push_back(p);
    }
    return true;
  }

  bool add_edges(std::span<const std::array<std::uint32_t, 2>> edges) {
    for (std::uint32_t v = 0; v < point_.size(); ++v) vertex_of_.push_back({point_[v], v});
    std::sort(vertex_of_.begin(), vertex_of_.end());
    return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
      return mesh_.insert_edge(vertex_of(edge[0]), vertex_of(edge[1]), kFixed);
    });
  }

  void fill(CutTriangle& result) const {
    for (std::uint32_t slot = 0; slot < mesh_.slots(); ++slot) {
      if (slot % 3 == 0) result.corners.emplace_back();
      result.corners.back()[slot % 3] = point_[mesh_.vertex_at(slot)];
      result.across.push_back(mesh_.mark_of(slot) == kNone ? mesh_.across(slot) : kNone);
    }
  }

 private:
  static constexpr std::uint32_t kFixed = 0;

  [[nodiscard]] std::uint32_t vertex_of(std::uint32_t point) const {
    return std::lower_bound(vertex_of_.begin(), vertex_of_.end(), std::array{point, 0u})->back();
  }

  const CutSet& cut_;
  const ArrangedPoints& points_;
  const std::uint32_t triangle_;
  PlanarMesh mesh_;
  std::vector<Point> at_;
  std::vector<std::uint32_t> point_;                     // of each vertex
  std::vector<std::array<std::uint32_t, 2>> vertex_of_;  // points and their vertices, sorted
};

// Each once, in the order in which they come first.
void make_unique(std::vector<std::uint32_t>& list) {
  std::vector<std::array<std::uint32_t, 2>> sorted;
  for (std::uint32_t i = 0; i < list.size(); ++i) sorted.push_back({list[i], i});
  std::sort(sorted.begin(), sorted.end());
  std::vector<char> comes_first(list.size(), 0);
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (i == 0 || sorted[i][0] != sorted[i - 1][0]) comes_first[sorted[i][1]] = 1;
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (comes_first[i] != 0) list[count++] = list[i];
  }
  list.resize(count);
}

std::vector<std::uint32_t> FacetArranger::points_on_side(std::uint32_t t, std::size_t k) const {
  std::vector<std::uint32_t> list;
  const std::uint32_t edge = cut_.edge(t, k);
  for (const std::uint32_t p : edge_points_[edge]) list.push_back(points_->settled(p));
  make_unique(list);
  if (cut_.corners(t)[k] != cut_.ends(edge)[0]) std::reverse(list.begin(), list.end());
  return list;
}

bool FacetArranger::triangulate(std::uint32_t t, CutTriangle& result) const {
  // Next to each other in the lists is mostly near each other in the triangle.
  std::array<std::vector<std::uint32_t>, 3> on_sides;
  std::vector<std::uint32_t> inside, outline(cut_.corners(t).begin(), cut_.corners(t).end());
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (std::size_t k = 0; k < 3; ++k) {
    on_sides[k] = points_on_side(t, k);
    outline.insert(outline.end(), on_sides[k].begin(), on_sides[k].end());
  }
  for (const std::uint32_t p : contacts_.of(t)) inside.push_back(points_->settled(p));
  for (const auto& list : line_points_[t]) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::uint32_t p = points_->settled(list[i]);
      inside.push_back(p);
      if (i == 0) continue;
      const std::uint32_t q = points_->settled(list[i - 1]);
      if (p != q) edges.push_back({std::min(p, q), std::max(p, q)});
    }
  }
  make_unique(inside);
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  std::sort(outline.begin(), outline.end());
  std::erase_if(inside, [&](std::uint32_t p) {
    return std::binary_search(outline.begin(), outline.end(), p);
  });
  TriangleFiller filler(cut_, *points_, t);
  filler.add_corners(outline.size() + inside.size());
  for (std::uint32_t k = 0; k < 3; ++k) filler.add_on_side(k, on_sides[k]);
  if (!filler.add_inside(inside) || !filler.add_edges(edges)) return false;
  filler.fill(result);
  return true;
}

}  // namespace

std::optional<ArrangedFacets> arrange_facets(const CutSet& cut, std::span<const CutSet::Pair> pairs,
                                             std::optional<ArrangedPoints>& points,
                                             ProgressObserver* progress) {
  return FacetArranger(cut, points, progress).run(pairs);
}

}  // namespace meshrepair::internal
