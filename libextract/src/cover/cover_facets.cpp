// SPDX-License-Identifier: MIT
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
//
// Facets are judged block by block by several threads, all as they are before any of the block is
// cut; then those that have to be are cut, in their order. A cut puts vertices into edges of
// facets around, which changes nothing that was said of them: each lies between the ends of its
// edge. In a loose complex it may not, so there each facet is judged when its turn has come.
#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <base/assert.h>
#include <base/error.h>
#include <base/parallel.h>
#include <exact/predicates.h>
#include <extract/cover_facets.h>
#include <extract/float_engine.h>

#include "cells/complex_edit.h"
#include "facet_judge.h"

namespace meshrepair {
namespace {

using internal::FacetCut;
using internal::FacetJudge;
using internal::Undecided;

// Of a block, which is also how often progress is told.
constexpr std::size_t kFacetsPerBlock = 65536;
// Of a task, a millisecond of work.
constexpr std::size_t kFacetsPerTask = 2048;
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
        wants_layers_(wants_layers),
        judge_(complex) {}

  IdVector<FacetId, Cover> run() {
    const std::size_t count = complex_.facets.size();
    for (std::size_t first = 0; first < count; first += kFacetsPerBlock) {
      tell_progress(first, count);
      const std::size_t size = std::min(kFacetsPerBlock, count - first);
      if (!complex_.loose) judge_block(first, size);
      cover_block(first, size);
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
    std::vector<Undecided> undecided;
  };

  // What is known of a facet before any of its block is cut. Its triangles are ranges of those of
  // its task, up to these ends.
  struct Judged {
    FacetId facet;
    std::uint32_t covering_end = 0, undecided_end = 0;
    std::uint32_t cut = kNone;
  };

  struct Task {
    std::vector<Judged> facets;
    std::vector<TriangleId> covering;
    std::vector<Undecided> undecided;
    std::vector<FacetCut> cuts;
    std::vector<Undecided> of_facet;  // scratch
  };

  void judge_block(std::size_t begin, std::size_t size) {
    tasks_.resize(std::max(tasks_.size(), tasks_of(size, kFacetsPerTask)));
    for (Task& task : tasks_) task.facets.clear();
    parallel_tasks(size, kFacetsPerTask, [&](std::size_t t, std::size_t first, std::size_t last) {
      Task& task = tasks_[t];
      task.covering.clear();
      task.undecided.clear();
      task.cuts.clear();
      FacetJudge judge(complex_);
      for (FacetId f(begin + first); f.index() < begin + last; ++f.value) {
        if (complex_.facets[f].triangle_count > 0) judge_facet(f, judge, task);
      }
    });
  }

  void judge_facet(FacetId facet, FacetJudge& judge, Task& task) const {
    list_triangles(facet, task.of_facet);
    const std::optional<FacetCut> cut = judge.judge(facet, task.of_facet, task.covering);
    Judged& judged = task.facets.emplace_back();
    judged.facet = facet;
    judged.covering_end = static_cast<std::uint32_t>(task.covering.size());
    if (!task.of_facet.empty()) {
      MESHREPAIR_ASSERT(cut.has_value());
      judged.cut = static_cast<std::uint32_t>(task.cuts.size());
      task.cuts.push_back(*cut);
      task.undecided.insert(task.undecided.end(), task.of_facet.begin(), task.of_facet.end());
    }
    judged.undecided_end = static_cast<std::uint32_t>(task.undecided.size());
  }

  void list_triangles(FacetId facet, std::vector<Undecided>& list) const {
    const Facet& f = complex_.facets[facet];
    list.clear();
    for (std::uint32_t i = 0; i < f.triangle_count; ++i) {
      list.push_back({complex_.facet_triangles[f.first_triangle + i], 0});
    }
  }

  void cover_block(std::size_t begin, std::size_t size) {
    if (complex_.loose) {
      for (FacetId f(begin); f.index() < begin + size; ++f.value) {
        if (complex_.facets[f].triangle_count == 0) continue;
        Piece whole{f, {}};
        list_triangles(f, whole.undecided);
        count_cuts(whole.undecided.size());
        pieces_.push_back(std::move(whole));
        cover_pieces();
      }
      return;
    }
    for (const Task& task : tasks_) {
      std::uint32_t covering = 0;
      std::uint32_t undecided = 0;
      for (const Judged& judged : task.facets) {
        while (covering < judged.covering_end) add_cover(judged.facet, task.covering[covering++]);
        if (undecided == judged.undecided_end) continue;
        Piece whole{judged.facet, {}};
        whole.undecided.assign(
            task.undecided.begin() + static_cast<std::ptrdiff_t>(undecided),
            task.undecided.begin() + static_cast<std::ptrdiff_t>(judged.undecided_end));
        undecided = judged.undecided_end;
        divide(whole, task.cuts[judged.cut]);
        cover_pieces();
      }
    }
  }

  // In a loose complex a facet gets no more cuts than what the lines through 3 n edges divide a
  // plane into.
  void count_cuts(std::size_t triangles) {
    const std::size_t lines = 3 * triangles;
    cuts_left_ = 1 + lines + lines * (lines - 1) / 2;
  }

  void cover_pieces() {
    while (!pieces_.empty()) {
      Piece piece = std::move(pieces_.back());
      pieces_.pop_back();
      // One facet with very many overlapping triangles may fall into millions of pieces.
      if (++ticks_ % kTicksPerQuestion == 0 && progress_ != nullptr && progress_->cancelled()) {
        throw Cancelled();
      }
      covering_.clear();
      const std::optional<FacetCut> cut = judge_.judge(piece.facet, piece.undecided, covering_);
      for (const TriangleId t : covering_) add_cover(piece.facet, t);
      if (piece.undecided.empty()) continue;
      if (complex_.loose && (!cut || cuts_left_ == 0)) {
        guess(piece);
        continue;
      }
      MESHREPAIR_ASSERT(cut.has_value());
      divide(piece, *cut);
    }
  }

  // Cuts a piece and gives each half the triangles that reach to its side.
  void divide(const Piece& piece, const FacetCut& cut) {
    const Halves halves = split(piece.facet, cut.plane);
    ++report_.split_facets;
    if (complex_.loose) --cuts_left_;
    Piece positive{halves.positive, {}};
    Piece negative{halves.negative, {}};
    for (Undecided u : piece.undecided) {
      const FacetJudge::Reach reach = judge_.reach_of(u.triangle, cut.plane);
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
      if (judge_.covers_centre(piece.facet, u.triangle)) add_cover(piece.facet, u.triangle);
    }
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

  void tell_progress(std::size_t done, std::size_t all) {
    if (progress_ == nullptr) return;
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
  FacetJudge judge_;
  std::vector<Task> tasks_;  // of a block
  std::vector<Piece> pieces_;
  std::vector<TriangleId> covering_;  // a piece
  // Scratch of one cut.
  IdVector<VertexId, std::int8_t> sides_;
  std::vector<UseId> crossed_, ends_;
  std::vector<FacetId> more_negative_;
  std::size_t cuts_left_ = 0;  // of the facet in hand, in a loose complex
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
