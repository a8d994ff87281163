// SPDX-License-Identifier: MIT
// Cell separation (WM 4.2.3).
//
// After facet clipping no edge joins the two sides. With right answers each facet is on one side,
// and the edges between the sides form one simple closed curve; on a sphere such a curve leaves
// exactly two disks (Jordan), so tracing it proves that the separation is sound and nothing more is
// needed. Otherwise the paper's flooding decides.
#include <chrono>

#include <extract/clip_cell.h>

#include "complex_edit.h"

namespace meshrepair {

CellId Clipper::clip(CellId cell, PlaneId plane) {
  ++report_.clips;
  ++stamp_;
  classify_vertices(cell, plane);
  split_edges(plane);
  for (const FacetId f : to_clip_) clip_facet(f, plane);

  sort_by_side();
  collect_curve_from_clips(cell);
  if (!plain_ || !trace_curve(cell)) {
    const auto start = std::chrono::steady_clock::now();
    flood_regions(cell, plane);
    report_.flood_seconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  return internal::separate_cell(complex_, cell, plane, curve_, below_, above_);
}

void Clipper::sort_by_side() {
  below_.clear();
  above_.clear();
  for (const FacetId f : facets_) (facet_sides_[f] == kBelow ? below_ : above_).push_back(f);
}

FacetId Clipper::across(UseId use, CellId cell) {
  return complex_.uses[internal::find_mate(complex_, use, cell)].facet;
}

// An edge between a facet below and one above has both ends on the plane, so it was there and seen
// while classifying, or a facet's clipping made it.
void Clipper::collect_curve_from_clips(CellId cell) {
  curve_.clear();
  for (const UseId u : on_plane_) {
    if (facet_sides_[complex_.uses[u].facet] != kBelow) continue;
    if (facet_sides_[across(u, cell)] == kAbove) curve_.push_back(u);
  }
}

// The same for sides that have nothing to do with signs.
void Clipper::collect_curve_from_sides(CellId cell) {
  curve_.clear();
  for (const FacetId f : below_) {
    complex_.for_each_use(f, [&](UseId u) {
      if (facet_sides_[across(u, cell)] == kAbove) curve_.push_back(u);
    });
  }
}

// Puts the curve in order, as facets below pass it seen from outside; false when it is not one
// simple loop.
bool Clipper::trace_curve(CellId cell) {
  ++curve_stamp_;
  const auto start_of = [&](UseId u) {
    const Use& use = complex_.uses[u];
    const bool outward = complex_.facets[use.facet].below == cell;
    return outward ? complex_.origin(use) : complex_.target(use);
  };
  const auto end_of = [&](UseId u) {
    const Use& use = complex_.uses[u];
    const bool outward = complex_.facets[use.facet].below == cell;
    return outward ? complex_.target(use) : complex_.origin(use);
  };
  for (const UseId u : curve_) {
    VertexMark& mark = vertex_marks_[start_of(u)];
    if (mark.out_stamp == curve_stamp_) return false;
    mark.out = u;
    mark.out_stamp = curve_stamp_;
  }
  const std::size_t edges = curve_.size();
  if (edges == 0) return false;
  const UseId first = curve_[0];
  curve_.clear();
  UseId u = first;
  do {
    curve_.push_back(u);
    const VertexMark& mark = vertex_marks_[end_of(u)];
    if (mark.out_stamp != curve_stamp_) return false;
    u = mark.out;
  } while (u != first);
  return curve_.size() == edges;
}

}  // namespace meshrepair
