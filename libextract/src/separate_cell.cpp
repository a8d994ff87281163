// Cell separation (WM 4.2.3).
//
// After facet clipping no edge joins the two sides. With right answers each facet is on one side, and the
// edges between the sides form one simple closed curve; on a sphere such a curve leaves exactly two disks
// (Jordan), so tracing it proves that the separation is sound and nothing more is needed. Otherwise the
// paper's flooding decides.
#include <extract/clip_cell.h>

#include "complex_edit.h"

namespace meshrepair {

CellId Clipper::clip(CellId cell, PlaneId plane) {
  ++report_.clips;
  ++stamp_;
  classify_vertices(cell, plane);
  split_edges(plane);
  clip_facets(cell, plane);

  facet_sides_.resize(complex_.facets.size());
  if (!decide_by_signs() || !trace_curve(cell, true)) flood_regions(cell, plane);
  return internal::separate_cell(complex_, cell, plane, curve_, below_, above_);
}

// False when there is a facet with both signs, or none on one of the sides.
bool Clipper::decide_by_signs() {
  below_.clear();
  above_.clear();
  bool mixed = false;
  for (const FacetId f : facets_) {
    bool above = false;
    bool below = false;
    complex_.for_each_use(f, [&](UseId u) {
      const int s = side_of(complex_.origin(complex_.uses[u]));
      above |= s > 0;
      below |= s < 0;
    });
    mixed |= above && below;
    facet_sides_[f] = below ? kBelow : kAbove;
    (below ? below_ : above_).push_back(f);
  }
  return !mixed && !below_.empty() && !above_.empty();
}

// Collects the curve between below_ and above_; false when it is not one simple loop. When the sides are
// those of the signs, only edges with both ends on the plane can be part of it.
bool Clipper::trace_curve(CellId cell, bool on_plane_only) {
  curve_.clear();
  std::size_t edges = 0;
  UseId start;
  bool simple = true;
  const auto leave = [&](VertexId v, UseId use) {
    VertexMark& mark = vertex_marks_[v];
    simple &= mark.out_stamp != curve_stamp_;
    mark.out = use;
    mark.out_stamp = curve_stamp_;
    start = use;
    ++edges;
  };
  ++curve_stamp_;
  for (const FacetId f : below_) {
    const bool outward = complex_.facets[f].below == cell;
    complex_.for_each_use(f, [&](UseId u) {
      const Use& use = complex_.uses[u];
      if (on_plane_only && (side_of(complex_.origin(use)) | side_of(complex_.target(use))) != 0) return;
      if (facet_sides_[across(u, cell)] != kAbove) return;
      leave(outward ? complex_.origin(use) : complex_.target(use), u);
    });
  }
  if (!simple || edges == 0) return false;
  UseId u = start;
  do {
    curve_.push_back(u);
    const Use& use = complex_.uses[u];
    const bool outward = complex_.facets[use.facet].below == cell;
    const VertexMark& mark = vertex_marks_[outward ? complex_.target(use) : complex_.origin(use)];
    if (mark.out_stamp != curve_stamp_) return false;
    u = mark.out;
  } while (u != start);
  return curve_.size() == edges;
}

void Clipper::sort_by_side() {
  below_.clear();
  above_.clear();
  for (const FacetId f : facets_) (facet_sides_[f] == kBelow ? below_ : above_).push_back(f);
}

}  // namespace meshrepair
