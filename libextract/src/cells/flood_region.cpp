// SPDX-License-Identifier: MIT
// Region flooding and region processing (WM 4.2.3, Procedure 3), for when the signs are not those
// of a plane and a convex cell.
//
// Why the curve is always simple: the flooded part M is connected across edges. Were the boundary
// of a region R outside it to touch itself at a vertex, R would have two fans there with M between
// them on both sides; a closed path through R and that vertex would separate the two fans of M,
// which M, connected across edges, does not allow. So each R is a disk, and so is everything else
// together.
#include <algorithm>
#include <limits>

#include <base/assert.h>
#include <extract/clip_cell.h>

namespace meshrepair {

void Clipper::flood_regions(CellId cell, PlaneId plane) {
  ++report_.region_floods;
  for (const FacetId f : facets_) facet_sides_[f] = kUndecided;
  flood_below(cell, plane);
  keep_largest_region(cell, plane);
  sort_by_side();
  collect_curve_from_sides(cell);
  MESHREPAIR_ASSERT(trace_curve(cell));
}

// The facet at the vertex farthest below.
FacetId Clipper::lowest_facet(PlaneId plane) const {
  FacetId lowest = facets_[0];
  double depth = std::numeric_limits<double>::infinity();
  for (const FacetId f : facets_) {
    complex_.for_each_use(f, [&](UseId u) {
      const VertexId v = complex_.origin(complex_.uses[u]);
      // Vertices that count as below come first, whatever their rounded distance.
      const double distance =
          signed_distance(complex_.vertices[v].position, complex_.planes[plane]);
      const double key = side_of(v) < 0 ? std::min(distance, 0.0) - 0x1p60 : distance;
      if (key < depth) {
        depth = key;
        lowest = f;
      }
    });
  }
  return lowest;
}

void Clipper::flood_below(CellId cell, PlaneId plane) {
  const FacetId seed = lowest_facet(plane);
  facet_sides_[seed] = kBelow;
  queue_.assign(1, seed);
  while (!queue_.empty()) {
    const FacetId f = queue_.back();
    queue_.pop_back();
    complex_.for_each_use(f, [&](UseId u) {
      const Use& use = complex_.uses[u];
      if (side_of(complex_.origin(use)) >= 0 && side_of(complex_.target(use)) >= 0) return;
      const FacetId next = across(u, cell);
      if (facet_sides_[next] == kBelow) return;
      facet_sides_[next] = kBelow;
      queue_.push_back(next);
    });
  }
}

// Region processing: of the connected regions that the flood left, the one of largest area is
// above.
void Clipper::keep_largest_region(CellId cell, PlaneId plane) {
  std::size_t regions = 0;
  double largest = -1;
  std::vector<FacetId> best;
  for (const FacetId start : facets_) {
    if (facet_sides_[start] != kUndecided) continue;
    ++regions;
    std::vector<FacetId> region = {start};
    facet_sides_[start] = kAbove;
    double area = 0;
    for (std::size_t i = 0; i < region.size(); ++i) {
      area += facet_area(complex_, region[i]);
      complex_.for_each_use(region[i], [&](UseId u) {
        const FacetId next = across(u, cell);
        if (facet_sides_[next] != kUndecided) return;
        facet_sides_[next] = kAbove;
        region.push_back(next);
      });
    }
    if (area > largest) {
      largest = area;
      best.swap(region);
    }
  }
  if (regions == 0) {
    force_farthest_above(plane);
    return;
  }
  report_.several_regions += regions > 1;
  for (const FacetId f : facets_) facet_sides_[f] = kBelow;
  for (const FacetId f : best) facet_sides_[f] = kAbove;
}

void Clipper::force_farthest_above(PlaneId plane) {
  ++report_.forced_cuts;
  const auto height = [&](FacetId f) {
    return signed_distance(facet_centre(complex_, f), complex_.planes[plane]);
  };
  const FacetId farthest = *std::max_element(
      facets_.begin(), facets_.end(), [&](FacetId a, FacetId b) { return height(a) < height(b); });
  facet_sides_[farthest] = kAbove;
}

}  // namespace meshrepair
