// Merging of facets.
//
// Why a vertex between two regions may go: the edges on both sides of it lie in the planes of both
// regions. If the planes differ they lie in one line; if not, a predicate says whether they do.
// They cannot fold back, as only ends of singular edges have two edges in one place, and these
// stay.
//
// Where solids touch, edges and vertices stay on both: a vertex of one must not come to lie inside
// a triangle of the other.
#include <algorithm>
#include <numeric>
#include <utility>

#include <bsp/disjoint_sets.h>
#include <bsp/predicates.h>
#include <extract/merge_facets.h>

namespace meshrepair {
namespace {

class FacetMerger {
 public:
  FacetMerger(const CellComplex& complex, const IdVector<FacetId, Cover>& cover,
              const std::vector<char>& solid, const Boundary& boundary,
              const ManifoldCorners& corners)
      : complex_(complex), cover_(cover), solid_(solid), boundary_(boundary), corners_(corners) {}

  MergedFacets run() {
    find_regions();
    list_polygons();
    find_kept_vertices();
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
        if (!belong_together(p, q)) continue;
        result_.dissolved[s] = 1;
        joined.join(p, q);
      }
    };
    dissolve([&](std::uint32_t p, std::uint32_t q) { return same_surface(p, q); });
    const std::vector<char> cut = find_cut_polygons(joined);
    dissolve([&](std::uint32_t p, std::uint32_t q) {
      return cut[p] != 0 && cut[q] != 0 && plane_of(p) == plane_of(q);
    });
    number_regions(joined);
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
      cut[p] = t.valid() && polygons[joined.root(p)] < facets[t.index()];
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
  void find_kept_vertices() {
    constexpr std::uint32_t kNone = ManifoldCorners::kNone;
    std::vector<char> sectors(corners_.vertices(), 0);
    std::vector<std::uint32_t> opening(corners_.vertices(), kNone);
    for (std::uint32_t s = 0; s < boundary_.sides(); ++s) {
      if (result_.dissolved[s] != 0) continue;
      char& count = sectors[corners_.vertex[s]];
      if (count < 3) ++count;
      opening[corners_.vertex[s]] = s;
    }
    result_.kept.resize(corners_.vertices());
    for (std::uint32_t v = 0; v < corners_.vertices(); ++v) {
      const bool goes = sectors[v] == 0 || (sectors[v] == 2 && goes_straight_on(opening[v]));
      result_.kept[v] = corners_.singular[v] != 0 || !goes ? 1 : 0;
      if (sectors[v] == 0 && result_.kept[v] != 0) {
        ++result_.kept_corners[result_.region[boundary_.polygon[corners_.vertex_corner[v]]]];
      }
    }
  }

  // Whether the edge between regions that leads to the start of `side` is in line with it.
  [[nodiscard]] bool goes_straight_on(std::uint32_t side_out) const {
    std::uint32_t side_in = boundary_.previous(side_out);
    while (result_.dissolved[side_in] != 0) side_in = boundary_.previous(corners_.mate[side_in]);
    const Edge& edge = complex_.edges[complex_.uses[boundary_.use[side_in]].edge()];
    const VertexId beyond = corner_vertex(complex_, boundary_, boundary_.next(side_out), solid_);
    return side(complex_.vertices[beyond], edge.planes[0], complex_.planes) == 0 &&
           side(complex_.vertices[beyond], edge.planes[1], complex_.planes) == 0;
  }

  void count_kept_corners() {
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
  MergedFacets result_;
};

}  // namespace

MergedFacets merge_facets(const CellComplex& complex, const IdVector<FacetId, Cover>& cover,
                          const std::vector<char>& solid, const Boundary& boundary,
                          const ManifoldCorners& corners) {
  return FacetMerger(complex, cover, solid, boundary, corners).run();
}

}  // namespace meshrepair
