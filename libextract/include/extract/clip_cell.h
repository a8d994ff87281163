// SPDX-License-Identifier: MIT
// Cutting one cell of a complex by a plane (WM 4.2), with a topology that cannot fail.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <extract/cell_complex.h>
#include <extract/predicate_engine.h>

namespace meshrepair {

// How often each step had to go beyond the plain case. All but `clips` stay 0 with exact predicates
// and a valid tree: a plane meets a convex cell in one convex polygon.
struct ClipReport {
  std::size_t clips = 0;
  std::size_t loose_points = 0;     // an edge met the plane at no exact point
  std::size_t several_groups = 0;   // a facet's vertices changed side more than twice (WM fig. 6b)
  std::size_t region_floods = 0;    // the signs alone did not give one simple closed curve
  std::size_t several_regions = 0;  // the flood left more than one region above (WM fig. 7)
  std::size_t forced_cuts = 0;      // it left none, and a facet was forced above

  double flood_seconds = 0;

  [[nodiscard]] std::size_t fallbacks() const {
    return loose_points + several_groups + region_floods;
  }
};

// Holds scratch memory between cuts; one clipper per complex.
class Clipper {
 public:
  Clipper(CellComplex& complex, PredicateEngine& engine) : complex_(complex), engine_(engine) {}

  // Cuts `cell` by `plane`. The part above keeps the cell's id; the part below is the new cell
  // returned. The new facet between them has plane `plane`. Whatever the engine answers, both parts
  // are closed surfaces of genus 0 with at least two facets each, and all other cells stay closed.
  // A cell has at least two facets.
  CellId clip(CellId cell, PlaneId plane);

  [[nodiscard]] const ClipReport& report() const { return report_; }

 private:
  static constexpr std::int8_t kBelow = -1;
  static constexpr std::int8_t kUndecided = 0;
  static constexpr std::int8_t kAbove = 1;

  // Edge splitting (WM 4.2.1)
  void classify_vertices(CellId cell, PlaneId plane);
  void classify_vertex(VertexId vertex, PlaneId plane);
  void split_edges(PlaneId plane);
  // Facet clipping (WM 4.2.2)
  void clip_facet(FacetId facet, PlaneId plane);
  void cut_off_run(FacetId facet, const std::vector<UseId>& loop, std::int8_t sign, PlaneId plane);
  void split_into_star(FacetId facet, const std::vector<UseId>& loop, PlaneId plane);
  FacetId split_and_share(FacetId facet, UseId from, UseId to, PlaneId plane);
  void share_triangles(FacetId a, FacetId b, PlaneId plane);
  // Cell separation (WM 4.2.3)
  void sort_by_side();
  void collect_curve_from_clips(CellId cell);
  void collect_curve_from_sides(CellId cell);
  bool trace_curve(CellId cell);
  void flood_regions(CellId cell, PlaneId plane);
  void flood_below(CellId cell, PlaneId plane);
  void keep_largest_region(CellId cell, PlaneId plane);
  void force_farthest_above(PlaneId plane);

  [[nodiscard]] int side_of(VertexId v) const { return vertex_marks_[v].side; }
  [[nodiscard]] FacetId across(UseId use, CellId cell);
  [[nodiscard]] FacetId lowest_facet(PlaneId plane) const;

  struct VertexMark {
    std::uint32_t stamp = 0;
    std::int32_t side = 0;
    UseId out;                    // the use of the separating curve that leaves this vertex ...
    std::uint32_t out_stamp = 0;  // ... if this is the curve at hand
  };

  CellComplex& complex_;
  PredicateEngine& engine_;
  ClipReport report_;
  std::uint32_t stamp_ = 0;
  std::uint32_t curve_stamp_ = 0;
  IdVector<VertexId, VertexMark> vertex_marks_;
  IdVector<FacetId, std::int8_t> facet_sides_;
  std::vector<FacetId> facets_;   // of the cell, the ones that clipping adds included
  std::vector<FacetId> to_clip_;  // with vertices on both sides
  std::vector<EdgeId> to_split_;  // with ends on both sides
  std::vector<UseId> loop_;       // of one facet
  std::vector<UseId> on_plane_;   // with both ends on the plane, or made by clipping a facet
  std::vector<UseId> curve_;      // uses by facets below, in order once it is traced
  std::vector<FacetId> below_, above_;
  bool plain_ = true;  // something is above, and no facet had several groups
  std::vector<FacetId> queue_;
  std::vector<TriangleId> triangles_;
};

}  // namespace meshrepair
