// SPDX-License-Identifier: MIT
// Facet clipping (WM 4.2.2): every facet with vertices on both sides is divided along vertices on
// the plane.
#include <algorithm>

#include <exact/predicates.h>
#include <extract/clip_cell.h>

#include "complex_edit.h"

namespace meshrepair {

void Clipper::clip_facet(FacetId facet, PlaneId plane) {
  loop_.clear();
  complex_.for_each_use(facet, [&](UseId u) { loop_.push_back(u); });
  // Count the groups: maximal runs of vertices on one side. Edges between the sides are split, so
  // vertices on the plane separate them.
  std::size_t above = 0;
  std::size_t below = 0;
  int previous = side_of(complex_.origin(complex_.uses[loop_.back()]));
  for (const UseId u : loop_) {
    const int s = side_of(complex_.origin(complex_.uses[u]));
    if (s != previous) {
      above += s > 0;
      below += s < 0;
    }
    previous = s;
  }
  if (below == 1) {
    cut_off_run(facet, loop_, kBelow, plane);
  } else if (above == 1) {
    cut_off_run(facet, loop_, kAbove, plane);
  } else {
    ++report_.several_groups;
    plain_ = false;
    split_into_star(facet, loop_, plane);
  }
}

// Links the first vertices on the plane before and behind the only group with this sign.
void Clipper::cut_off_run(FacetId facet, const std::vector<UseId>& loop, std::int8_t sign,
                          PlaneId plane) {
  const std::size_t n = loop.size();
  const auto side_at = [&](std::size_t i) {
    return side_of(complex_.origin(complex_.uses[loop[i % n]]));
  };
  std::size_t first = 0;
  while (!(side_at(first) == sign && side_at(first + n - 1) != sign)) ++first;
  std::size_t behind = first;
  while (side_at(behind) == sign) ++behind;
  const UseId enter = loop[(first + n - 1) % n];
  const UseId leave = loop[behind % n];
  const FacetId run = split_and_share(facet, leave, enter, plane);
  facet_sides_[run] = sign;
  facet_sides_[facet] = static_cast<std::int8_t>(-sign);
  on_plane_.push_back(complex_.uses[sign == kBelow ? enter : leave].previous);
}

// WM fig. 6b: a new vertex at the centre, linked to one vertex on the plane between any two groups.
void Clipper::split_into_star(FacetId facet, const std::vector<UseId>& loop, PlaneId plane) {
  std::vector<UseId> spokes;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::size_t before = i > 0 ? i - 1 : loop.size() - 1;
    if (side_of(complex_.origin(complex_.uses[loop[i]])) == 0 &&
        side_of(complex_.origin(complex_.uses[loop[before]])) != 0) {
      spokes.push_back(loop[i]);
    }
  }
  // The first link becomes two spokes when the centre is put into it; the others start at the
  // centre.
  const auto centre = facet_centre(complex_, facet);
  FacetId rest = split_and_share(facet, spokes[0], spokes[1], plane);
  const EdgeId link = complex_.uses[complex_.uses[spokes[1]].previous].edge();
  const VertexId hub =
      internal::split_edge(complex_, link, loose_point(centre, engine_.tolerance()));
  ++report_.loose_points;
  vertex_marks_.push_back({stamp_, 0, {}, 0});
  for (std::size_t k = 2; k < spokes.size(); ++k) {
    UseId at_hub = complex_.uses[spokes[k - 1]].previous;
    while (complex_.origin(complex_.uses[at_hub]) != hub) at_hub = complex_.uses[at_hub].previous;
    rest = split_and_share(rest, at_hub, spokes[k], plane);
  }
}

FacetId Clipper::split_and_share(FacetId facet, UseId from, UseId to, PlaneId plane) {
  const FacetId added = internal::split_facet(complex_, facet, from, to, plane);
  facets_.push_back(added);
  facet_sides_.push_back(kUndecided);
  if (complex_.facets[facet].triangle_count > 0) share_triangles(facet, added, plane);
  return added;
}

// Gives the triangles that may cover a split facet to the parts that they can reach. Exactly,
// whatever the engine: one that takes a thin triangle to be on the plane would give it to neither.
void Clipper::share_triangles(FacetId a, FacetId b, PlaneId plane) {
  const auto side_of_facet = [&](FacetId f) {
    int sum = 0;
    complex_.for_each_use(f, [&](UseId u) {
      const int s = side_of(complex_.origin(complex_.uses[u]));
      if (sum == 0) sum = s;
    });
    return sum;
  };
  const int side_a = side_of_facet(a);
  const int side_b = side_of_facet(b);
  if (side_a * side_b >= 0) return;  // several groups: both may be reached by all

  const Facet parent = complex_.facets[a];
  auto& pool = complex_.facet_triangles;
  const CleanSoup& soup = complex_.soup();
  const auto reaches = [&](TriangleId t, int wanted) {
    const auto& corners = soup.triangles[t].corners;
    return std::any_of(corners.begin(), corners.end(), [&](PointId p) {
      return side(lattice_point(soup.grid_points[p]), plane, complex_.planes) == wanted;
    });
  };
  // In place: those for a alone, for both, for b alone; then the two ranges overlap and nothing is
  // copied, unless both are there: then b gets a range of its own, so that later splits can sort
  // each.
  triangles_.clear();
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < parent.triangle_count; ++i) {
    const TriangleId t = pool[parent.first_triangle + i];
    if (reaches(t, side_b)) triangles_.push_back(t);
    if (reaches(t, side_a)) pool[parent.first_triangle + kept++] = t;
  }
  complex_.facets[a].triangle_count = kept;
  Facet& other = complex_.facets[b];
  other.triangle_count = static_cast<std::uint32_t>(triangles_.size());
  if (kept > 0 && !triangles_.empty()) {
    other.first_triangle = begin_of_list(pool.size(), triangles_.size());
    for (const TriangleId t : triangles_) pool.push_back(t);
  } else {
    std::copy(triangles_.begin(), triangles_.end(), pool.begin() + other.first_triangle);
  }
}

}  // namespace meshrepair
