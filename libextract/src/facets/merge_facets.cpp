// SPDX-License-Identifier: MIT
// Merging of facets.
//
// Why a vertex between two regions may go: the edges on both sides of it lie in the planes of both
// regions. If the planes differ they lie in one line; if not, a predicate says whether they do.
// They cannot fold back: only ends of singular edges have two edges in one place, and these stay
// unless the edges on both sides are two different ones of the complex.
//
// Where solids touch, edges and vertices stay on both: a vertex of one must not come to lie inside
// a triangle of the other. Only in the middle of an edge along which they touch a vertex may go,
// if it goes from all of them.
#include "merge_facets.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include <base/disjoint_sets.h>
#include <exact/predicates.h>

namespace meshrepair::internal {
namespace {

class FacetMerger {
 public:
  FacetMerger(const CellComplex& complex, const IdVector<FacetId, Cover>& cover,
              const std::vector<char>& solid, const Boundary& boundary,
              const ManifoldCorners& corners, std::span<const char> alone, bool merges_triangles)
      : complex_(complex),
        cover_(cover),
        solid_(solid),
        boundary_(boundary),
        corners_(corners),
        alone_(alone),
        merges_triangles_(merges_triangles) {}

  MergedFacets run() {
    find_regions();
    list_polygons();
    count_sectors();
    find_kept_vertices();
    if (corners_.singular_edges > 0) release_middles_of_touching_edges();
    keep_vertices_of_polygons_alone();
    count_kept_corners();
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool same_surface(std::uint32_t p, std::uint32_t q) const {
    const TriangleId a = cover_[boundary_.facet[p]].triangle;
    const TriangleId b = cover_[boundary_.facet[q]].triangle;
    if (a.valid() || b.valid()) return a == b;
    return plane_of(p) == plane_of(q);
  }

  [[nodiscard]] PlaneId plane_of(std::uint32_t polygon) const {
    return complex_.facets[boundary_.facet[polygon]].plane;
  }

  void find_regions() {
    DisjointSets joined(boundary_.polygons());
    result_.dissolved.assign(boundary_.sides(), 0);
    const auto dissolve = [&](auto belong_together) {
      for (std::uint32_t s = 0; s < boundary_.sides(); ++s) {
        if (corners_.singular_side[s] != 0 || result_.dissolved[s] != 0) continue;
        const std::uint32_t p = boundary_.polygon[s];
        const std::uint32_t q = boundary_.polygon[corners_.mate[s]];
        if (is_alone(p) || is_alone(q) || !belong_together(p, q)) continue;
        result_.dissolved[s] = 1;
        joined.join(p, q);
      }
    };
    dissolve([&](std::uint32_t p, std::uint32_t q) { return same_surface(p, q); });
    if (merges_triangles_) {
      const std::vector<char> cut = find_cut_polygons(joined);
      dissolve([&](std::uint32_t p, std::uint32_t q) {
        return cut[p] != 0 && cut[q] != 0 && plane_of(p) == plane_of(q);
      });
    }
    number_regions(joined);
  }

  [[nodiscard]] bool is_alone(std::uint32_t polygon) const {
    return !alone_.empty() && alone_[polygon] != 0;
  }

  void keep_vertices_of_polygons_alone() {
    if (alone_.empty()) return;
    for (std::uint32_t s = 0; s < boundary_.sides(); ++s) {
      if (is_alone(boundary_.polygon[s])) result_.kept[corners_.vertex[s]] = 1;
    }
  }

  // Polygons covered by a triangle of which not all is one region.
  std::vector<char> find_cut_polygons(DisjointSets& joined) const {
    std::vector<std::uint32_t> facets(complex_.soup().triangles.size(), 0);
    for (const Cover& c : cover_) {
      if (c.opaque()) ++facets[c.triangle.index()];
    }
    std::vector<std::uint32_t> polygons(boundary_.polygons(), 0);
    for (std::uint32_t p = 0; p < boundary_.polygons(); ++p) ++polygons[joined.root(p)];
    std::vector<char> cut(boundary_.polygons(), 0);
    for (std::uint32_t p = 0; p < boundary_.polygons(); ++p) {
      const TriangleId t = cover_[boundary_.facet[p]].triangle;
      if (t.valid()) cut[p] = polygons[joined.root(p)] < facets[t.index()];
    }
    return cut;
  }

  void number_regions(DisjointSets& joined) {
    std::vector<std::uint32_t> roots;
    for (std::uint32_t p = 0; p < boundary_.polygons(); ++p) {
      if (joined.root(p) == p) roots.push_back(p);
    }
    const auto triangle_of = [&](std::uint32_t p) {
      return cover_[boundary_.facet[p]].triangle.value;  // all ones when there is none
    };
    std::stable_sort(roots.begin(), roots.end(), [&](std::uint32_t p, std::uint32_t q) {
      return triangle_of(p) < triangle_of(q);
    });
    result_.region.resize(boundary_.polygons());
    for (std::uint32_t r = 0; r < roots.size(); ++r) result_.region[roots[r]] = r;
    for (std::uint32_t p = 0; p < boundary_.polygons(); ++p) {
      result_.region[p] = result_.region[joined.root(p)];
    }
    result_.kept_corners.assign(roots.size(), 0);
  }

  void list_polygons() {
    result_.first.assign(result_.regions() + 1, 0);
    for (const std::uint32_t r : result_.region) ++result_.first[r + 1];
    std::partial_sum(result_.first.begin(), result_.first.end(), result_.first.begin());
    result_.list.resize(boundary_.polygons());
    std::vector<std::uint32_t> at(result_.first.begin(), result_.first.end() - 1);
    for (std::uint32_t p = 0; p < boundary_.polygons(); ++p) {
      result_.list[at[result_.region[p]]++] = p;
    }
  }

  // Each edge between regions that starts at a vertex opens one sector of a region there.
  void count_sectors() {
    sectors_.assign(corners_.vertices(), 0);
    opening_.assign(corners_.vertices(), kNone);
    for (std::uint32_t s = 0; s < boundary_.sides(); ++s) {
      if (result_.dissolved[s] != 0) continue;
      char& count = sectors_[corners_.vertex[s]];
      if (count < 3) ++count;
      opening_[corners_.vertex[s]] = s;
    }
  }

  void find_kept_vertices() {
    result_.kept.resize(corners_.vertices());
    for (std::uint32_t v = 0; v < corners_.vertices(); ++v) {
      const bool goes = sectors_[v] == 0 || (sectors_[v] == 2 && goes_straight_on(opening_[v]));
      result_.kept[v] = corners_.singular[v] != 0 || !goes ? 1 : 0;
    }
  }

  // Whether the edge between regions that leads to the start of `side` is in line with it.
  [[nodiscard]] bool goes_straight_on(std::uint32_t side_out) const {
    const std::uint32_t side_in = previous_on_outline(side_out);
    const VertexId beyond = place_of(boundary_.next(side_out));
    if (complex_.loose) {
      return lies_between(complex_.vertices[place_of(side_out)],
                          complex_.vertices[place_of(side_in)], complex_.vertices[beyond]);
    }
    const Edge& edge = complex_.edges[edge_of(side_in)];
    return side(complex_.vertices[beyond], edge.planes[0], complex_.planes) == 0 &&
           side(complex_.vertices[beyond], edge.planes[1], complex_.planes) == 0;
  }

  [[nodiscard]] std::uint32_t previous_on_outline(std::uint32_t s) const {
    s = boundary_.previous(s);
    while (result_.dissolved[s] != 0) s = boundary_.previous(corners_.mate[s]);
    return s;
  }

  [[nodiscard]] std::uint32_t next_on_outline(std::uint32_t s) const {
    return result_.next_on_outline(boundary_, corners_, s);
  }

  [[nodiscard]] EdgeId edge_of(std::uint32_t s) const {
    return complex_.uses[boundary_.use[s]].edge();
  }

  // Of the complex, at the start of a side.
  [[nodiscard]] VertexId place_of(std::uint32_t s) const {
    return corner_vertex(complex_, boundary_, s, solid_);
  }

  // The two edges, of those at which solids touch, between which all copies of a vertex lie.
  struct Passage {
    enum State : std::uint8_t { unseen, straight, stays };
    State state = unseen;
    EdgeId a, b;
  };

  void release_middles_of_touching_edges() {
    IdVector<VertexId, Passage> passages(complex_.vertices.size());
    for_each_singular_vertex([&](std::uint32_t v, VertexId place) {
      Passage& known = passages[place];
      const Passage own = passage_of(v);
      if (known.state == Passage::unseen) known = own;
      if (own.state != known.state || own.a != known.a || own.b != known.b) {
        known.state = Passage::stays;
      }
    });
    for_each_singular_vertex([&](std::uint32_t v, VertexId place) {
      if (passages[place].state == Passage::straight) result_.kept[v] = 0;
    });
    for (const VertexId place : middles_to_stay()) passages[place].state = Passage::stays;
    for_each_singular_vertex([&](std::uint32_t v, VertexId place) {
      if (passages[place].state == Passage::stays) result_.kept[v] = 1;
    });
  }

  template <class Visit>
  void for_each_singular_vertex(Visit visit) {
    for (std::uint32_t v = 0; v < corners_.vertices(); ++v) {
      if (corners_.singular[v] != 0) visit(v, place_of(corners_.vertex_corner[v]));
    }
  }

  [[nodiscard]] Passage passage_of(std::uint32_t v) const {
    if (sectors_[v] != 2) return {Passage::stays, {}, {}};
    const std::uint32_t out = opening_[v];
    const std::uint32_t in = previous_on_outline(out);
    if (corners_.singular_side[in] == 0 || corners_.singular_side[out] == 0 ||
        edge_of(in) == edge_of(out) || !goes_straight_on(out)) {
      return {Passage::stays, {}, {}};
    }
    return {Passage::straight, std::min(edge_of(in), edge_of(out)),
            std::max(edge_of(in), edge_of(out))};
  }

  // A straight row of touching edges without the vertices between them, seen from one side.
  struct Row {
    EdgeId edge;  // the lower one of those at its ends
    std::uint32_t start, end;
    VertexId middle;  // one of those that went
  };

  // Where two wedges have both ends of a row in common, one vertex of the row has to stay, or four
  // triangles would share an edge. Each wedge has two sides along the row.
  [[nodiscard]] std::vector<VertexId> middles_to_stay() const {
    std::vector<Row> rows;
    for (std::uint32_t s = 0; s < boundary_.sides(); ++s) {
      if (corners_.singular_side[s] == 0 || result_.kept[corners_.vertex[s]] == 0) continue;
      std::uint32_t last = s, next = next_on_outline(s);
      if (result_.kept[corners_.vertex[next]] != 0) continue;
      const VertexId middle = place_of(next);
      for (; result_.kept[corners_.vertex[next]] == 0; next = next_on_outline(next)) last = next;
      const auto [start, end] = std::minmax(corners_.vertex[s], corners_.vertex[next]);
      rows.push_back({std::min(edge_of(s), edge_of(last)), start, end, middle});
    }
    const auto key = [](const Row& row) { return std::tuple(row.edge, row.start, row.end); };
    std::stable_sort(rows.begin(), rows.end(),
                     [&](const Row& x, const Row& y) { return key(x) < key(y); });
    std::vector<VertexId> staying;
    for (std::size_t i = 2; i < rows.size(); ++i) {
      if (key(rows[i]) == key(rows[i - 2])) staying.push_back(rows[i - 2].middle);
    }
    return staying;
  }

  void count_kept_corners() {
    for (std::uint32_t v = 0; v < corners_.vertices(); ++v) {
      if (sectors_[v] != 0 || result_.kept[v] == 0) continue;
      ++result_.kept_corners[result_.region[boundary_.polygon[corners_.vertex_corner[v]]]];
    }
    for (std::uint32_t s = 0; s < boundary_.sides(); ++s) {
      if (result_.dissolved[s] == 0 && result_.kept[corners_.vertex[s]] != 0) {
        ++result_.kept_corners[result_.region[boundary_.polygon[s]]];
      }
    }
  }

  const CellComplex& complex_;
  const IdVector<FacetId, Cover>& cover_;
  const std::vector<char>& solid_;
  const Boundary& boundary_;
  const ManifoldCorners& corners_;
  std::span<const char> alone_;
  const bool merges_triangles_;
  // Of each vertex: how many regions meet there, up to 3, and a side between regions that starts
  // there.
  std::vector<char> sectors_;
  std::vector<std::uint32_t> opening_;
  MergedFacets result_;
};

}  // namespace

bool lies_between(const Point& point, const Point& a, const Point& b) {
  const auto vector = [](const Point& p) {
    return Vec3d(p.position[0], p.position[1], p.position[2]);
  };
  const Vec3d along = vector(b) - vector(a);
  const Vec3d from_a = vector(point) - vector(a);
  const double length = along.norm();
  const double reach = from_a.dot(along);
  return reach > 0 && reach < length * length &&
         from_a.cross(along).norm() <= static_cast<double>(point.error) * length;
}

MergedFacets merge_facets(const CellComplex& complex, const IdVector<FacetId, Cover>& cover,
                          const std::vector<char>& solid, const Boundary& boundary,
                          const ManifoldCorners& corners, std::span<const char> alone,
                          bool merges_triangles) {
  return FacetMerger(complex, cover, solid, boundary, corners, alone, merges_triangles).run();
}

}  // namespace meshrepair::internal
