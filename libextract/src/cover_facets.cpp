// Coverage of facets.
//
// Idea: the triangles of a node ride on the facets that the node's plane made, so each facet has a
// short list of triangles that may cover it. On a closed input the planes of neighbouring triangles
// have already cut the facets along all edges, and each test says "full" or "none". Where it says
// "part" (triangles in one plane, open borders) the facet is cut along an edge of such a triangle,
// and both halves are looked at again with the triangles that are still undecided: a small
// partition of the plane, made on demand.
//
// Invariant: an edge chosen for a cut crosses the facet and never crosses its parts, so it ends.
#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <bsp/assert.h>
#include <bsp/error.h>
#include <bsp/predicates.h>
#include <extract/cover_facets.h>

#include "complex_edit.h"
#include "prepared_triangle.h"

namespace meshrepair {
namespace {

using internal::Coverage;
using internal::coverage_of;
using internal::PreparedTriangle;

// How many triangles offer their edges for a cut, and on how many each offer is judged.
constexpr std::size_t kOffers = 6;
constexpr std::size_t kJudged = 24;
// Up to here every triangle is asked what it covers before the facet is cut.
constexpr std::size_t kFew = 8;
constexpr std::size_t kTicksPerProgress = 8192;
constexpr std::size_t kTicksPerQuestion = 256;

class FacetCoverer {
 public:
  FacetCoverer(CellComplex& complex, const IdVector<TriangleId, std::int32_t>& winding,
               CoverReport& report, ProgressObserver* progress, bool wants_layers)
      : complex_(complex),
        winding_(winding),
        report_(report),
        progress_(progress),
        cover_(complex.facets.size()),
        wants_layers_(wants_layers) {}

  IdVector<FacetId, Cover> run() {
    const std::size_t count = complex_.facets.size();
    for (FacetId f(0u); f.index() < count; ++f.value) {
      tell_progress(f.index(), count);
      const Facet& facet = complex_.facets[f];
      if (facet.triangle_count == 0) continue;
      const auto first = complex_.facet_triangles.begin() + facet.first_triangle;
      cover(f, {first, first + facet.triangle_count});
    }
    for (const Cover& c : cover_) report_.opaque_facets += c.opaque();
    complex_.facet_triangles = {};
    for (Facet& f : complex_.facets) f.first_triangle = f.triangle_count = 0;
    return std::move(cover_);
  }

  // After run().
  [[nodiscard]] std::vector<CoverLayer> layers() const {
    std::vector<CoverLayer> list;
    for (FacetId f(0u); f.index() < top_layer_.size(); ++f.value) {
      for (std::uint32_t l = top_layer_[f.index()]; l != kNoLayer; l = layers_[l].below) {
        list.push_back({f, layers_[l].triangle});
      }
    }
    return list;
  }

 private:
  static constexpr std::uint32_t kNoLayer = ~std::uint32_t{0};

  // Facets that were split off one another share the layers that they had before.
  struct Layer {
    TriangleId triangle;
    std::uint32_t below;
  };

  struct Piece {
    FacetId facet;
    std::vector<TriangleId> undecided;
  };

  void cover(FacetId facet, std::vector<TriangleId> triangles) {
    pieces_.push_back({facet, std::move(triangles)});
    while (!pieces_.empty()) {
      Piece piece = std::move(pieces_.back());
      pieces_.pop_back();
      // One facet with very many overlapping triangles may fall into millions of pieces.
      if (++ticks_ % kTicksPerQuestion == 0 && progress_ != nullptr && progress_->cancelled()) {
        throw Cancelled();
      }
      // With many triangles the facet is cut first and asked about later: most of them will be
      // elsewhere.
      std::optional<Plane> cut;
      if (piece.undecided.size() > kFew) cut = choose_cut(piece);
      if (!cut) {
        decide(piece);
        if (piece.undecided.empty()) continue;
        cut = choose_cut(piece);
        MESHREPAIR_ASSERT(cut.has_value());
      }
      divide(piece, *cut);
    }
  }

  // Cuts a piece and gives each half the triangles that reach to its side.
  void divide(const Piece& piece, const Plane& cut) {
    const Halves halves = split(piece.facet, cut);
    ++report_.split_facets;
    Piece positive{halves.positive, {}};
    Piece negative{halves.negative, {}};
    for (const TriangleId t : piece.undecided) {
      const Reach reach = reach_of(t, cut);
      if (reach.positive) positive.undecided.push_back(t);
      if (reach.negative) negative.undecided.push_back(t);
    }
    if (!negative.undecided.empty()) pieces_.push_back(std::move(negative));
    if (!positive.undecided.empty()) pieces_.push_back(std::move(positive));
  }

  // Applies the triangles that cover all of the facet and drops those that miss it.
  void decide(Piece& piece) {
    std::size_t kept = 0;
    for (const TriangleId t : piece.undecided) {
      const Coverage coverage = coverage_of(complex_, piece.facet, prepared(t));
      if (coverage == Coverage::part) piece.undecided[kept++] = t;
      if (coverage == Coverage::full) {
        add_cover(piece.facet, t);
      }
    }
    piece.undecided.resize(kept);
  }

  void add_cover(FacetId facet, TriangleId t) {
    Cover& c = cover_[facet];
    c.winding += winding_[t];
    if (c.opaque() && wants_layers_) {
      top_layer_.resize(std::max(top_layer_.size(), facet.index() + 1), kNoLayer);
      layers_.push_back({std::max(t, c.triangle), top_layer_[facet.index()]});
      top_layer_[facet.index()] = static_cast<std::uint32_t>(layers_.size() - 1);
    }
    if (!c.opaque() || t < c.triangle) c.triangle = t;
  }

  // An edge that crosses the facet, cuts few of the undecided triangles and leaves both sides
  // alike; nothing when none of the edges looked at crosses it. With few triangles all are looked
  // at.
  std::optional<Plane> choose_cut(const Piece& piece) {
    const auto& list = piece.undecided;
    const std::size_t offers = list.size() > kFew ? kOffers : list.size();
    std::size_t best_cost = std::numeric_limits<std::size_t>::max();
    std::optional<Plane> best;
    for (std::size_t k = 0; k < offers; ++k) {
      const PreparedTriangle offered = prepared(list[k * list.size() / offers]);
      for (const Plane& edge : offered.edges) {
        const std::size_t cost = list.size() > 1 ? cost_of(edge, list) : 0;
        const bool tie_won = best && cost == best_cost && comes_before(edge, *best);
        if ((cost < best_cost || tie_won) && internal::crosses(complex_, piece.facet, edge)) {
          best_cost = cost;
          best = edge;
        }
      }
    }
    return best;
  }

  std::size_t cost_of(const Plane& edge, const std::vector<TriangleId>& list) const {
    const std::size_t judged = std::min(kJudged, list.size());
    std::size_t cut = 0, positive = 0, negative = 0;
    for (std::size_t j = 0; j < judged; ++j) {
      const Reach reach = reach_of(list[j * list.size() / judged], edge);
      (reach.positive && reach.negative ? cut : reach.positive ? positive : negative) += 1;
    }
    return 8 * cut + std::max(positive, negative) - std::min(positive, negative);
  }

  struct Reach {
    bool positive = false, negative = false;
  };

  Reach reach_of(TriangleId t, const Plane& plane) const {
    Reach reach;
    for (const PointId p : complex_.soup().triangles[t].corners) {
      const int s = side(complex_.soup().grid_points[p], plane);
      reach.positive |= s > 0;
      reach.negative |= s < 0;
    }
    return reach;
  }

  struct Halves {
    FacetId positive, negative;
  };

  // Cuts the facet, which is convex, along a plane that crosses it.
  Halves split(FacetId facet, const Plane& along) {
    const PlaneId plane = complex_.planes.append(along);
    crossed_.clear();
    complex_.for_each_use(facet, [&](UseId u) {
      const Use& use = complex_.uses[u];
      if (side_of(complex_.origin(use), plane) * side_of(complex_.target(use), plane) < 0) {
        crossed_.push_back(u);
      }
    });
    for (const UseId u : crossed_) {
      const Edge& edge = complex_.edges[complex_.uses[u].edge()];
      const auto& a = complex_.vertices[edge.ends[0]].position;
      const auto& b = complex_.vertices[edge.ends[1]].position;
      const Point at = meet(complex_.planes, edge.planes[0], edge.planes[1], plane,
                            {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])});
      internal::split_edge(complex_, complex_.uses[u].edge(), at);
    }
    ends_.clear();
    complex_.for_each_use(facet, [&](UseId u) {
      if (side_of(complex_.origin(complex_.uses[u]), plane) == 0) ends_.push_back(u);
    });
    MESHREPAIR_ASSERT(ends_.size() == 2);
    const int kept_side = side_of(complex_.target(complex_.uses[ends_[0]]), plane);
    const FacetId added = internal::split_facet(complex_, facet, ends_[0], ends_[1], plane);
    cover_.push_back(cover_[facet]);
    if (facet.index() < top_layer_.size() && top_layer_[facet.index()] != kNoLayer) {
      top_layer_.resize(cover_.size(), kNoLayer);
      top_layer_.back() = top_layer_[facet.index()];
    }
    return kept_side > 0 ? Halves{facet, added} : Halves{added, facet};
  }

  int side_of(VertexId v, PlaneId plane) const {
    return side(complex_.vertices[v], plane, complex_.planes);
  }

  // Facets of one node follow each other and mostly ask for the same triangle.
  const PreparedTriangle& prepared(TriangleId t) {
    if (t != prepared_id_) {
      prepared_ = internal::prepare_triangle(complex_.soup(), t);
      prepared_id_ = t;
    }
    return prepared_;
  }

  void tell_progress(std::size_t done, std::size_t all) {
    if (progress_ == nullptr || done % kTicksPerProgress != 0) return;
    if (progress_->cancelled()) throw Cancelled();
    progress_->advance(static_cast<double>(done) / static_cast<double>(all));
  }

  CellComplex& complex_;
  const IdVector<TriangleId, std::int32_t>& winding_;
  CoverReport& report_;
  ProgressObserver* progress_;
  IdVector<FacetId, Cover> cover_;
  bool wants_layers_;
  std::vector<std::uint32_t> top_layer_;  // of each facet, as far as there are any
  std::vector<Layer> layers_;
  std::vector<Piece> pieces_;
  std::vector<UseId> crossed_, ends_;  // scratch
  PreparedTriangle prepared_;
  TriangleId prepared_id_;
  std::size_t ticks_ = 0;
};

}  // namespace

IdVector<FacetId, Cover> cover_facets(CellComplex& complex,
                                      const IdVector<TriangleId, std::int32_t>& winding,
                                      CoverReport& report, ProgressObserver* progress,
                                      std::vector<CoverLayer>* layers) {
  report = {};
  FacetCoverer coverer(complex, winding, report, progress, layers != nullptr);
  IdVector<FacetId, Cover> cover = coverer.run();
  if (layers != nullptr) *layers = coverer.layers();
  return cover;
}

}  // namespace meshrepair
