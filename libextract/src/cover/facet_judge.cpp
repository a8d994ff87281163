#include "facet_judge.h"

#include <algorithm>
#include <limits>

#include <exact/predicates.h>

namespace meshrepair::internal {
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
