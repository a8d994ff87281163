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

void Clipper::classify_vertices(CellId cell, PlaneId plane) {
  vertex_marks_.resize(complex_.vertices.size());
  facets_.clear();
  to_clip_.clear();
  to_split_.clear();
  complex_.for_each_facet(cell, [&](FacetId f) {
    facets_.push_back(f);
    bool above = false;
    bool below = false;
    int previous_side = 0;
    const UseId first = complex_.facets[f].first_use;
    UseId previous;
    UseId u = first;
    do {
      const Use& use = complex_.uses[u];
      const VertexId v = complex_.origin(use);
      classify_vertex(v, plane);
      const int s = side_of(v);
      above |= s > 0;
      below |= s < 0;
      if (s * previous_side < 0) to_split_.push_back(complex_.uses[previous].edge);
      previous_side = s;
      previous = u;
      u = use.next;
    } while (u != first);
    if (previous_side * side_of(complex_.origin(complex_.uses[first])) < 0) {
      to_split_.push_back(complex_.uses[previous].edge);
    }
    if (above && below) to_clip_.push_back(f);
  });
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
