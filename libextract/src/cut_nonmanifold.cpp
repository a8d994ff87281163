// Cutting at singular edges and vertices.
//
// Steps: pair the sides of polygons along each edge of the complex (two sides: with each other;
// more: with the next boundary facet met when turning through solid cells). Join the corners that
// paired sides have in common. Each class of corners is one fan, and becomes one vertex.
#include <algorithm>
#include <utility>

#include <bsp/assert.h>
#include <bsp/disjoint_sets.h>
#include <extract/cut_nonmanifold.h>

namespace meshrepair {
namespace {

constexpr std::uint32_t kNone = ManifoldCorners::kNone;

class NonmanifoldCutter {
 public:
  NonmanifoldCutter(const CellComplex& complex, const Boundary& boundary,
                    const std::vector<char>& solid)
      : complex_(complex), boundary_(boundary), solid_(solid), fans_(boundary.sides()) {}

  ManifoldCorners run() {
    list_sides_by_edge();
    pair_sides();
    join_corners();
    number_vertices();
    separate_common_edges();
    return std::move(result_);
  }

 private:
  [[nodiscard]] EdgeId edge_of(std::uint32_t side) const {
    return complex_.uses[boundary_.use[side]].edge();
  }

  // first_side_[edge] starts a list through next_side_.
  void list_sides_by_edge() {
    first_side_.assign(complex_.edges.size(), kNone);
    next_side_.assign(boundary_.sides(), kNone);
    for (auto s = static_cast<std::uint32_t>(boundary_.sides()); s-- > 0;) {
      std::uint32_t& first = first_side_[edge_of(s)];
      next_side_[s] = first;
      first = s;
    }
  }

  void pair_sides() {
    mate_.assign(boundary_.sides(), kNone);
    for (const std::uint32_t first : first_side_) {
      if (first == kNone) continue;
      const std::uint32_t second = next_side_[first];
      MESHREPAIR_ASSERT(second != kNone);
      if (next_side_[second] == kNone) {
        mate_[first] = second;
        mate_[second] = first;
        continue;
      }
      ++result_.singular_edges;
      for (std::uint32_t s = first; s != kNone; s = next_side_[s]) {
        if (mate_[s] == kNone) pair_through_solid(first, s);
      }
    }
  }

  // Turns around the edge from a side's facet through its solid cell until the next boundary facet.
  void pair_through_solid(std::uint32_t first, std::uint32_t side) {
    UseId use = boundary_.use[side];
    CellId cell = solid_side(complex_.uses[use].facet);
    for (;;) {
      use = complex_.mate(use, cell);
      const Facet& facet = complex_.facets[complex_.uses[use].facet];
      const CellId beyond = facet.above == cell ? facet.below : facet.above;
      if (!beyond.valid() || solid_[beyond.index()] == 0) break;
      cell = beyond;
    }
    for (std::uint32_t s = first; s != kNone; s = next_side_[s]) {
      if (boundary_.use[s] != use) continue;
      mate_[side] = s;
      mate_[s] = side;
      return;
    }
    throw InternalError("internal error: a wedge of solid cells does not end at a boundary facet");
  }

  [[nodiscard]] CellId solid_side(FacetId f) const {
    const Facet& facet = complex_.facets[f];
    return facet.above.valid() && solid_[facet.above.index()] != 0 ? facet.above : facet.below;
  }

  void join_corners() {
    for (std::uint32_t s = 0; s < boundary_.sides(); ++s) {
      // A side starts where its mate ends.
      fans_.join(s, boundary_.next(mate_[s]));
    }
  }

  void number_vertices() {
    result_.vertex.resize(boundary_.sides());
    std::vector<char> seen(complex_.vertices.size(), 0);
    for (std::uint32_t s = 0; s < boundary_.sides(); ++s) {
      const std::uint32_t r = fans_.root(s);
      if (r == s) {
        result_.vertex[s] = static_cast<std::uint32_t>(result_.vertex_corner.size());
        result_.vertex_corner.push_back(s);
        char& copies = seen[corner_vertex(complex_, boundary_, s, solid_).index()];
        if (copies == 1) ++result_.singular_vertices;
        if (copies < 2) ++copies;
      } else {
        result_.vertex[s] = result_.vertex[r];
      }
    }
  }

  // Two wedges at one edge whose ends are in the same fans: the edge would have four triangles.
  void separate_common_edges() {
    result_.middle.assign(boundary_.sides(), kNone);
    if (result_.singular_edges == 0) return;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> seen;
    for (const std::uint32_t first : first_side_) {
      if (first == kNone || next_side_[next_side_[first]] == kNone) continue;
      seen.clear();
      for (std::uint32_t s = first; s != kNone; s = next_side_[s]) {
        if (mate_[s] < s) continue;
        const auto ends = std::minmax(result_.vertex[s], result_.vertex[boundary_.next(s)]);
        const std::pair<std::uint32_t, std::uint32_t> key(ends.first, ends.second);
        if (std::find(seen.begin(), seen.end(), key) == seen.end()) {
          seen.push_back(key);
          continue;
        }
        const auto middle = static_cast<std::uint32_t>(result_.vertices());
        result_.middle_side.push_back(s);
        result_.middle[s] = middle;
        result_.middle[mate_[s]] = middle;
      }
    }
  }

  const CellComplex& complex_;
  const Boundary& boundary_;
  const std::vector<char>& solid_;
  IdVector<EdgeId, std::uint32_t> first_side_;
  std::vector<std::uint32_t> next_side_;
  std::vector<std::uint32_t> mate_;
  DisjointSets fans_;
  ManifoldCorners result_;
};

}  // namespace

ManifoldCorners cut_nonmanifold(const CellComplex& complex, const Boundary& boundary,
                                const std::vector<char>& solid) {
  return NonmanifoldCutter(complex, boundary, solid).run();
}

}  // namespace meshrepair
