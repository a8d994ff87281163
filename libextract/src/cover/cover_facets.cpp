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
// In a loose complex it may seem to cross them all the same, as the new vertices need not lie on
// it. So a triangle remembers which of its edges a facet was cut along, and these are not asked
// again; and a facet gets no more cuts than lines through it could make parts, after which the
// centre of a part decides. A facet that is not convex falls into more than two parts.
#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <base/assert.h>
#include <base/error.h>
#include <exact/predicates.h>
#include <extract/cover_facets.h>
#include <extract/float_engine.h>

#include "cells/complex_edit.h"
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
constexpr std::size_t kFacetsPerProgress = 8192;
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

  struct Undecided {
    TriangleId triangle;
    std::uint32_t inside = 0;  // bit k: the facet was cut off along edge k, and is inside of it
  };

  struct Piece {
    FacetId facet;
    std::vector<Undecided> undecided;
  };

  struct Cut {
    Plane plane;
    TriangleId triangle;
    std::size_t edge = 0;
  };

  void cover(FacetId facet, std::span<const TriangleId> triangles) {
    Piece whole{facet, {}};
    whole.undecided.reserve(triangles.size());
    for (const TriangleId t : triangles) whole.undecided.push_back({t, 0});
    pieces_.push_back(std::move(whole));
    // What the lines through 3 n edges divide a plane into.
    const std::size_t lines = 3 * triangles.size();
    cuts_left_ = 1 + lines + lines * (lines - 1) / 2;
    while (!pieces_.empty()) {
      Piece piece = std::move(pieces_.back());
      pieces_.pop_back();
      // One facet with very many overlapping triangles may fall into millions of pieces.
      if (++ticks_ % kTicksPerQuestion == 0 && progress_ != nullptr && progress_->cancelled()) {
        throw Cancelled();
      }
      // With many triangles the facet is cut first and asked about later: most of them will be
      // elsewhere.
      std::optional<Cut> cut;
      if (piece.undecided.size() > kFew) cut = choose_cut(piece);
      if (!cut) {
        decide(piece);
        if (piece.undecided.empty()) continue;
        cut = choose_cut(piece);
      }
      if (complex_.loose && (!cut || cuts_left_ == 0)) {
        guess(piece);
        continue;
      }
      MESHREPAIR_ASSERT(cut.has_value());
      divide(piece, *cut);
    }
  }

  // Cuts a piece and gives each half the triangles that reach to its side.
  void divide(const Piece& piece, const Cut& cut) {
    const Halves halves = split(piece.facet, cut.plane);
    ++report_.split_facets;
    --cuts_left_;
    Piece positive{halves.positive, {}};
    Piece negative{halves.negative, {}};
    for (Undecided u : piece.undecided) {
      const Reach reach = reach_of(u.triangle, cut.plane);
      if (reach.negative) negative.undecided.push_back(u);
      if (u.triangle == cut.triangle) u.inside |= std::uint32_t{1} << cut.edge;
      if (reach.positive) positive.undecided.push_back(u);
    }
    if (!negative.undecided.empty()) {
      for (const FacetId f : more_negative_) pieces_.push_back({f, negative.undecided});
      pieces_.push_back(std::move(negative));
    }
    if (!positive.undecided.empty()) pieces_.push_back(std::move(positive));
  }

  // The last resort.
  void guess(const Piece& piece) {
    ++report_.guessed_facets;
    for (const Undecided& u : piece.undecided) {
      if (internal::covers_centre(complex_, piece.facet, prepared(u.triangle))) {
        add_cover(piece.facet, u.triangle);
      }
    }
  }

  // Applies the triangles that cover all of the facet and drops those that miss it.
  void decide(Piece& piece) {
    std::size_t kept = 0;
    for (const Undecided& u : piece.undecided) {
      const Coverage coverage = coverage_of(complex_, piece.facet, prepared(u.triangle), u.inside);
      if (coverage == Coverage::part) piece.undecided[kept++] = u;
      if (coverage == Coverage::full) add_cover(piece.facet, u.triangle);
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
  std::optional<Cut> choose_cut(const Piece& piece) {
    const auto& list = piece.undecided;
    const std::size_t offers = list.size() > kFew ? kOffers : list.size();
    std::size_t best_cost = std::numeric_limits<std::size_t>::max();
    std::optional<Cut> best;
    for (std::size_t k = 0; k < offers; ++k) {
      const Undecided& from = list[k * list.size() / offers];
      const PreparedTriangle offered = prepared(from.triangle);
      for (std::size_t e = 0; e < 3; ++e) {
        const Plane& edge = offered.edges[e];
        if ((from.inside >> e & 1) != 0) continue;
        const std::size_t cost = list.size() > 1 ? cost_of(edge, list) : 0;
        const bool tie_won = best && cost == best_cost && comes_before(edge, best->plane);
        if ((cost < best_cost || tie_won) && internal::crosses(complex_, piece.facet, edge)) {
          best_cost = cost;
          best = Cut{edge, from.triangle, e};
        }
      }
    }
    return best;
  }

  std::size_t cost_of(const Plane& edge, const std::vector<Undecided>& list) const {
    const std::size_t judged = std::min(kJudged, list.size());
    std::size_t cut = 0, positive = 0, negative = 0;
    for (std::size_t j = 0; j < judged; ++j) {
      const Reach reach = reach_of(list[j * list.size() / judged].triangle, edge);
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

  // Cuts the facet along a plane that crosses it. One that is not convex may have several runs of
  // vertices on the negative side: all but one of the parts there are left in more_negative_.
  Halves split(FacetId facet, const Plane& along) {
    const PlaneId plane = complex_.planes.append(along);
    put_vertices_on(facet, plane);
    ends_.clear();
    complex_.for_each_use(facet, [&](UseId u) {
      if (side_of(complex_.origin(complex_.uses[u])) == 0) ends_.push_back(u);
    });
    more_negative_.clear();
    if (ends_.size() == 2) {
      const int kept_side = side_of(complex_.target(complex_.uses[ends_[0]]));
      const FacetId added = split_off(facet, ends_[0], ends_[1], plane);
      return kept_side > 0 ? Halves{facet, added} : Halves{added, facet};
    }
    MESHREPAIR_ASSERT(complex_.loose && ends_.size() > 2);
    FacetId negative;
    while (const auto run = negative_run(facet)) {
      if (negative.valid()) more_negative_.push_back(negative);
      negative = split_off(facet, run->second, run->first, plane);
    }
    return {facet, negative};
  }

  // Finds the sides of the facet's vertices, and splits the edges from one side to the other. The
  // new vertices are on the plane, whatever a predicate would say of a loose one.
  void put_vertices_on(FacetId facet, PlaneId plane) {
    sides_.resize(complex_.vertices.size());
    crossed_.clear();
    complex_.for_each_use(facet, [&](UseId u) {
      const VertexId v = complex_.origin(complex_.uses[u]);
      sides_[v] = static_cast<std::int8_t>(side(complex_.vertices[v], plane, complex_.planes));
    });
    complex_.for_each_use(facet, [&](UseId u) {
      const Use& use = complex_.uses[u];
      if (side_of(complex_.origin(use)) * side_of(complex_.target(use)) < 0) crossed_.push_back(u);
    });
    for (const UseId u : crossed_) {
      const EdgeId edge = complex_.uses[u].edge();
      internal::split_edge(complex_, edge, crossing(complex_.edges[edge], plane));
      sides_.push_back(0);
    }
  }

  [[nodiscard]] Point crossing(const Edge& edge, PlaneId plane) const {
    const Point& a = complex_.vertices[edge.ends[0]];
    const Point& b = complex_.vertices[edge.ends[1]];
    if (complex_.loose) return interpolate(a, b, complex_.planes[plane]);
    const auto& p = a.position;
    const auto& q = b.position;
    return meet(complex_.planes, edge.planes[0], edge.planes[1], plane,
                {0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]), 0.5 * (p[2] + q[2])});
  }

  // The uses that start at the vertices on the plane before and behind some run of vertices on the
  // negative side; there is none when no vertex is left there. Between two runs of different sides
  // there always is a vertex on the plane, and other runs of the positive side stay, so the two are
  // no neighbours either way round.
  [[nodiscard]] std::optional<std::pair<UseId, UseId>> negative_run(FacetId facet) const {
    UseId enter;
    complex_.for_each_use(facet, [&](UseId u) {
      const Use& use = complex_.uses[u];
      if (side_of(complex_.origin(use)) == 0 && side_of(complex_.target(use)) < 0) enter = u;
    });
    if (!enter.valid()) return std::nullopt;
    UseId leave = complex_.uses[enter].next;
    while (side_of(complex_.origin(complex_.uses[leave])) < 0) leave = complex_.uses[leave].next;
    return std::pair(enter, leave);
  }

  // What is covered already is so on both parts.
  FacetId split_off(FacetId facet, UseId from, UseId to, PlaneId plane) {
    const FacetId added = internal::split_facet(complex_, facet, from, to, plane);
    cover_.push_back(cover_[facet]);
    if (facet.index() < top_layer_.size() && top_layer_[facet.index()] != kNoLayer) {
      top_layer_.resize(cover_.size(), kNoLayer);
      top_layer_.back() = top_layer_[facet.index()];
    }
    return added;
  }

  [[nodiscard]] int side_of(VertexId v) const { return sides_[v]; }

  // Facets of one node follow each other and mostly ask for the same triangle.
  const PreparedTriangle& prepared(TriangleId t) {
    if (t != prepared_id_) {
      prepared_ = internal::prepare_triangle(complex_.soup(), t);
      prepared_id_ = t;
    }
    return prepared_;
  }

  void tell_progress(std::size_t done, std::size_t all) {
    if (progress_ == nullptr || done % kFacetsPerProgress != 0) return;
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
  // Scratch of one cut.
  IdVector<VertexId, std::int8_t> sides_;
  std::vector<UseId> crossed_, ends_;
  std::vector<FacetId> more_negative_;
  std::size_t cuts_left_ = 0;  // of the facet in hand
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
