// SPDX-License-Identifier: MIT
// Edge splitting (WM 4.2.1): the only step in which numbers decide.
#include <extract/clip_cell.h>

#include "complex_edit.h"

namespace meshrepair {

void Clipper::classify_vertex(VertexId vertex, PlaneId plane) {
  VertexMark& mark = vertex_marks_[vertex];
  if (mark.stamp == stamp_) return;
  mark.stamp = stamp_;
  mark.side = engine_.side(complex_.vertices[vertex], plane, complex_.planes);
}

// Also finds the edges and facets to be split, and the side of every facet that is not.
void Clipper::classify_vertices(CellId cell, PlaneId plane) {
  vertex_marks_.resize(complex_.vertices.size());
  facet_sides_.resize(complex_.facets.size());
  facets_.clear();
  to_clip_.clear();
  to_split_.clear();
  on_plane_.clear();
  bool any_above = false;
  complex_.for_each_facet(cell, [&](FacetId f) {
    facets_.push_back(f);
    bool above = false;
    bool below = false;
    const UseId first = complex_.facets[f].first_use;
    const VertexId start = complex_.origin(complex_.uses[first]);
    classify_vertex(start, plane);
    int side = side_of(start);
    UseId u = first;
    do {
      const Use& use = complex_.uses[u];
      const VertexId v = complex_.target(use);
      classify_vertex(v, plane);
      const int next_side = side_of(v);
      above |= next_side > 0;
      below |= next_side < 0;
      if (side * next_side < 0) to_split_.push_back(use.edge());
      if ((side | next_side) == 0) on_plane_.push_back(u);
      side = next_side;
      u = use.next;
    } while (u != first);
    facet_sides_[f] = below ? kBelow : kAbove;
    if (above && below) to_clip_.push_back(f);
    any_above |= above;
  });
  // Where the plane holds a facet and all else is below, that facet's border looks like a cut.
  plain_ = any_above;
}

void Clipper::split_edges(PlaneId plane) {
  for (const EdgeId e : to_split_) {
    const Edge edge = complex_.edges[e];
    // Both facets of the cell named the edge; the second time it is split already.
    if (side_of(edge.ends[0]) * side_of(edge.ends[1]) >= 0) continue;
    const Point at = engine_.cross(complex_.vertices[edge.ends[0]], complex_.vertices[edge.ends[1]],
                                   edge.planes[0], edge.planes[1], plane, complex_.planes);
    report_.loose_points += at.is_loose();
    internal::split_edge(complex_, e, at);
    vertex_marks_.push_back({stamp_, 0, {}, 0});
  }
}

}  // namespace meshrepair
