// SPDX-License-Identifier: MIT
#include "facet_judge.h"

#include <algorithm>
#include <limits>

#include <exact/predicates.h>

namespace meshrepair::internal {
namespace {

Plane turned(const Plane& p) {
  return make_plane({-p.normal[0], -p.normal[1], -p.normal[2]}, -p.offset);
}

// Two convex polygons in a plane are apart exactly if an edge of one of them separates them. This
// looks at the facet's edges.
bool separated_by_facet(const CellComplex& complex, FacetId facet, const PreparedTriangle& t) {
  bool separated = false;
  complex.for_each_use(facet, [&](UseId u) {
    if (separated) return;
    const PlaneId line = complex.side_plane(complex.uses[u]);
    int inside = 0;  // the side of the line on which the facet lies
    for (UseId w = complex.uses[u].next; w != u && inside == 0; w = complex.uses[w].next) {
      inside = side(complex.vertices[complex.target(complex.uses[w])], line, complex.planes);
    }
    separated = std::all_of(t.corners.begin(), t.corners.end(), [&](const Point& corner) {
      return inside * side(corner, line, complex.planes) <= 0;
    });
  });
  return separated;
}

}  // namespace

PreparedTriangle prepare_triangle(const CleanSoup& soup, TriangleId id) {
  const Triangle& triangle = soup.triangles[id];
  const int axis = dominant_axis(soup.planes[triangle.plane]);
  PreparedTriangle prepared;
  for (std::size_t k = 0; k < 3; ++k) {
    const GridPoint& a = soup.grid_points[triangle.corners[k]];
    const GridPoint& b = soup.grid_points[triangle.corners[(k + 1) % 3]];
    const GridPoint& opposite = soup.grid_points[triangle.corners[(k + 2) % 3]];
    prepared.corners[k] = lattice_point(a);
    prepared.edges[k] = plane_along_axis(a, b, axis);
    if (side(opposite, prepared.edges[k]) < 0) prepared.edges[k] = turned(prepared.edges[k]);
  }
  return prepared;
}

Coverage coverage_of(const CellComplex& complex, FacetId facet, const PreparedTriangle& triangle,
                     std::uint32_t inside) {
  bool any_outside = false;
  for (std::size_t k = 0; k < 3; ++k) {
    if ((inside >> k & 1) != 0) continue;
    const Plane& edge = triangle.edges[k];
    bool within = false;
    bool outside = false;
    complex.for_each_use(facet, [&](UseId u) {
      if (within && outside) return;
      const int s = side(complex.vertices[complex.origin(complex.uses[u])], edge, complex.planes);
      within |= s > 0;
      outside |= s < 0;
    });
    if (!within) return Coverage::none;
    any_outside |= outside;
  }
  if (!any_outside) return Coverage::full;
  return separated_by_facet(complex, facet, triangle) ? Coverage::none : Coverage::part;
}

bool covers_centre(const CellComplex& complex, FacetId facet, const PreparedTriangle& triangle) {
  const std::array<double, 3> centre = facet_centre(complex, facet);
  return std::all_of(triangle.edges.begin(), triangle.edges.end(),
                     [&](const Plane& edge) { return signed_distance(centre, edge) > 0; });
}

bool crosses(const CellComplex& complex, FacetId facet, const Plane& plane) {
  bool above = false;
  bool below = false;
  complex.for_each_use(facet, [&](UseId u) {
    const int s = side(complex.vertices[complex.origin(complex.uses[u])], plane, complex.planes);
    above |= s > 0;
    below |= s < 0;
  });
  return above && below;
}

namespace {

// How many triangles offer their edges for a cut, and on how many each offer is judged.
constexpr std::size_t kOffers = 6;
constexpr std::size_t kJudged = 24;
// Up to here every triangle is asked what it covers before the facet is cut.
constexpr std::size_t kFew = 8;

}  // namespace

std::optional<FacetCut> FacetJudge::judge(FacetId facet, std::vector<Undecided>& undecided,
                                          std::vector<TriangleId>& covering) {
  if (undecided.size() > kFew) {
    if (auto cut = choose_cut(facet, undecided)) return cut;
  }
  decide(facet, undecided, covering);
  if (undecided.empty()) return std::nullopt;
  return choose_cut(facet, undecided);
}

void FacetJudge::decide(FacetId facet, std::vector<Undecided>& undecided,
                        std::vector<TriangleId>& covering) {
  std::size_t kept = 0;
  for (const Undecided& u : undecided) {
    const Coverage coverage = coverage_of(complex_, facet, prepared(u.triangle), u.inside);
    if (coverage == Coverage::part) undecided[kept++] = u;
    if (coverage == Coverage::full) covering.push_back(u.triangle);
  }
  undecided.resize(kept);
}

// An edge that crosses the facet, cuts few of the undecided triangles and leaves both sides alike;
// nothing when none of the edges looked at crosses it. With few triangles all are looked at.
std::optional<FacetCut> FacetJudge::choose_cut(FacetId facet, const std::vector<Undecided>& list) {
  const std::size_t offers = list.size() > kFew ? kOffers : list.size();
  std::size_t best_cost = std::numeric_limits<std::size_t>::max();
  std::optional<FacetCut> best;
  for (std::size_t k = 0; k < offers; ++k) {
    const Undecided& from = list[k * list.size() / offers];
    const PreparedTriangle& offered = prepared(from.triangle);
    for (std::size_t e = 0; e < 3; ++e) {
      const Plane& edge = offered.edges[e];
      if ((from.inside >> e & 1) != 0) continue;
      const std::size_t cost = list.size() > 1 ? cost_of(edge, list) : 0;
      const bool tie_won = best && cost == best_cost && comes_before(edge, best->plane);
      if ((cost < best_cost || tie_won) && crosses(complex_, facet, edge)) {
        best_cost = cost;
        best = FacetCut{edge, from.triangle, e};
      }
    }
  }
  return best;
}

std::size_t FacetJudge::cost_of(const Plane& edge, const std::vector<Undecided>& list) const {
  const std::size_t judged = std::min(kJudged, list.size());
  std::size_t cut = 0, positive = 0, negative = 0;
  for (std::size_t j = 0; j < judged; ++j) {
    const Reach reach = reach_of(list[j * list.size() / judged].triangle, edge);
    (reach.positive && reach.negative ? cut : reach.positive ? positive : negative) += 1;
  }
  return 8 * cut + std::max(positive, negative) - std::min(positive, negative);
}

FacetJudge::Reach FacetJudge::reach_of(TriangleId t, const Plane& plane) const {
  Reach reach;
  for (const PointId p : complex_.soup().triangles[t].corners) {
    const int s = side(complex_.soup().grid_points[p], plane);
    reach.positive |= s > 0;
    reach.negative |= s < 0;
  }
  return reach;
}

}  // namespace meshrepair::internal
