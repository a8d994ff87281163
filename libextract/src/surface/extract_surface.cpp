// SPDX-License-Identifier: MIT
// The mesh of a solid given by its cells (WM 4.4). The paper takes every facet between a solid and
// an empty cell. Here such facets are merged again into the polygons that the input's triangles
// left (merge_facets.h), singular edges and vertices are cut apart (cut_nonmanifold.h), and each
// region is triangulated by itself (region_triangulator.h). So a triangle of the input that nothing
// cuts comes out as it was, from the corner that it began with.
//
// All of this but the choice of diagonals is combinatorial. It cannot fail where predicates are
// exact. In a loose complex, made by floating predicates, regions may be no polygons: then those
// that went wrong are set apart, facet by facet, and all is merged anew. That ends, as each round
// sets apart more, and with all facets apart nothing can go wrong.
#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include <base/ids.h>
#include <extract/boundary.h>
#include <extract/cut_nonmanifold.h>
#include <extract/extract_surface.h>
#include <mesh/topology.h>

#include "facets/merge_facets.h"
#include "input_points.h"
#include "loose_regions.h"
#include "region_triangulator.h"

namespace meshrepair {
namespace {

using internal::InputPoints;
using internal::RegionTriangle;

// All that is combinatorial.
struct MergedBoundary {
  Boundary boundary;
  ManifoldCorners corners;
  internal::MergedFacets merged;
  MiddleVertices middles;
  std::vector<char> alone;  // of each polygon: not to be merged with others; empty: none
  bool merges_triangles = true;
};

class SurfaceExtractor {
 public:
  SurfaceExtractor(const CellComplex& complex, const IdVector<FacetId, Cover>& cover,
                   const std::vector<char>& solid, const MergedBoundary& parts,
                   const InputPoints& input_points)
      : complex_(complex),
        cover_(cover),
        solid_(solid),
        boundary_(parts.boundary),
        corners_(parts.corners),
        merged_(parts.merged),
        middles_(parts.middles),
        alone_(parts.alone),
        input_points_(input_points) {}

  Surface run(ExtractReport& report, ProgressObserver* progress) {
    output_vertex_.assign(corners_.vertices(), kNone);
    output_middle_.assign(middles_.count, kNone);
    internal::RegionTriangulator triangulator(complex_, solid_, boundary_, corners_, merged_);
    std::vector<RegionTriangle> triangles;
    CancelCheck cancel(progress);
    for (std::uint32_t region = 0; region < merged_.regions(); ++region) {
      cancel.tick();
      const std::uint32_t first = merged_.polygons_of(region)[0];
      const TriangleId covering = cover_[boundary_.facet[first]].triangle;
      if (!alone_.empty() && alone_[first] != 0) {
        add_polygon(first, covering);
      } else if (triangulator.run(region, triangles)) {
        add(triangles, covering);
      } else {
        failed_.push_back(region);
      }
      region_of_triangle_.resize(surface_.mesh.triangles.size(), region);
    }
    report.boundary_facets = boundary_.polygons();
    report.regions = merged_.regions();
    report.unmerged_triangles = boundary_.sides() - 2 * boundary_.polygons();
    report.singular_edges = corners_.singular_edges;
    report.singular_vertices = corners_.singular_vertices;
    report.middle_vertices = middles_.count;
    return std::move(surface_);
  }

  // After run(): the regions whose triangles could not be found, and of each triangle its region.
  [[nodiscard]] const std::vector<std::uint32_t>& failed() const { return failed_; }
  [[nodiscard]] const std::vector<std::uint32_t>& region_of_triangle() const {
    return region_of_triangle_;
  }

 private:
  void add(std::vector<RegionTriangle>& triangles, TriangleId covering) {
    if (covering.valid() && triangles.size() == 1) {
      turn_like(complex_.soup().triangles[covering], triangles[0]);
    }
    for (const RegionTriangle& t : triangles) add(t, source_of(t, covering));
  }

  // A region may be made of several triangles of the input: one that the triangle lies in with an
  // edge of its own, if it has such an edge.
  [[nodiscard]] std::uint32_t source_of(const RegionTriangle& triangle, TriangleId covering) const {
    static_assert(Surface::kNoSource == Triangle::kNoSource);
    if (!covering.valid()) return Surface::kNoSource;
    for (const std::uint32_t s : triangle.sides) {
      if (s == kNone) continue;
      covering = cover_[boundary_.facet[boundary_.polygon[s]]].triangle;
      break;
    }
    return complex_.soup().triangles[covering].source;
  }

  // Makes a triangle start at the first corner of the input triangle, if that is one of its own.
  void turn_like(const Triangle& input, RegionTriangle& triangle) const {
    const auto lies_at = [&](std::uint32_t vertex, PointId corner) {
      const std::optional<GridPoint> at = InputPoints::lattice_of(point_of(vertex));
      return at && *at == complex_.soup().grid_points[corner];
    };
    for (std::size_t k = 0; k < 3; ++k) {
      if (!lies_at(triangle.vertices[k], input.corners[0])) continue;
      std::rotate(triangle.vertices.begin(), triangle.vertices.begin() + static_cast<long>(k),
                  triangle.vertices.end());
      std::rotate(triangle.sides.begin(), triangle.sides.begin() + static_cast<long>(k),
                  triangle.sides.end());
      return;
    }
  }

  void add(const RegionTriangle& triangle, std::uint32_t source) {
    corner_list_.clear();
    vertex_list_.clear();
    bool has_middle = false;
    for (std::size_t k = 0; k < 3; ++k) {
      add_corner(output_vertex(triangle.vertices[k]), false);
      const std::uint32_t s = triangle.sides[k];
      if (middles_.count == 0 || s == kNone || middles_.of_side[s] == kNone) continue;
      add_corner(output_middle(s), true);
      has_middle = true;
    }
    pieces_.clear();
    if (has_middle) {
      internal::triangulate_convex(corner_list_, pieces_);
    } else {
      pieces_.push_back({0, 1, 2});
    }
    for (const auto& t : pieces_) {
      surface_.mesh.triangles.push_back(
          {vertex_list_[t[0]], vertex_list_[t[1]], vertex_list_[t[2]]});
      surface_.source.push_back(source);
    }
  }

  // A polygon that is not merged with others and need not be flat nor convex. Edges from a point in
  // its middle are no edges of anything else; those between its corners might be. A polygon of two
  // sides has a vertex in the middle of both.
  void add_polygon(std::uint32_t polygon, TriangleId covering) {
    const std::uint32_t first = boundary_.first[polygon];
    const std::uint32_t last = boundary_.first[polygon + 1];
    std::vector<std::uint32_t> ring;
    for (std::uint32_t s = first; s < last; ++s) {
      ring.push_back(output_vertex(corners_.vertex[s]));
      if (middles_.count > 0 && middles_.of_side[s] != kNone) ring.push_back(output_middle(s));
    }
    if (ring.size() == 3) {
      std::vector<RegionTriangle> whole(1);
      for (std::uint32_t k = 0; k < 3; ++k) whole[0].vertices[k] = corners_.vertex[first + k];
      whole[0].sides = {kNone, kNone, kNone};
      add(whole, covering);
      return;
    }
    Vec3d centre = Vec3d::Zero();
    for (const std::uint32_t v : ring) {
      centre += surface_.mesh.points[v] / static_cast<double>(ring.size());
    }
    const std::uint32_t hub = add_point(centre, false);
    const std::uint32_t source =
        covering.valid() ? complex_.soup().triangles[covering].source : Surface::kNoSource;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      surface_.mesh.triangles.push_back({ring[k], ring[(k + 1) % ring.size()], hub});
      surface_.source.push_back(source);
    }
  }

  void add_corner(std::uint32_t output, bool straight) {
    const Vec3d& at = surface_.mesh.points[output];
    corner_list_.push_back({{at.x(), at.y(), at.z()}, straight});
    vertex_list_.push_back(output);
  }

  // Vertices are numbered in the order in which triangles use them.
  std::uint32_t output_vertex(std::uint32_t vertex) {
    std::uint32_t& output = output_vertex_[vertex];
    if (output == kNone) {
      const Point& at = point_of(vertex);
      const PointId input = input_of(vertex);
      output = add_point(
          input.valid() ? complex_.soup().points[input]
                        : complex_.soup().grid.from_grid(accurate_position(at, complex_.planes)),
          input.valid());
    }
    return output;
  }

  // Of several loose points that are taken for one of the input, the first is it.
  PointId input_of(std::uint32_t vertex) {
    const VertexId at = place_of(vertex);
    const PointId input = input_points_.find(complex_.vertices[at]);
    if (!complex_.loose || !input.valid()) return input;
    if (taken_by_.empty()) taken_by_.assign(complex_.soup().points.size(), VertexId());
    VertexId& owner = taken_by_[input];
    if (!owner.valid()) owner = at;
    return owner == at ? input : PointId();
  }

  std::uint32_t add_point(const Vec3d& at, bool of_input) {
    surface_.mesh.points.push_back(at);
    surface_.input_point.push_back(of_input ? 1 : 0);
    return static_cast<std::uint32_t>(surface_.mesh.points.size() - 1);
  }

  std::uint32_t output_middle(std::uint32_t side) {
    std::uint32_t& output = output_middle_[middles_.of_side[side]];
    if (output == kNone) {
      const std::uint32_t a = output_vertex(corners_.vertex[side]);
      const std::uint32_t b = output_vertex(corners_.vertex[boundary_.next(side)]);
      output = add_point(0.5 * surface_.mesh.points[a] + 0.5 * surface_.mesh.points[b], false);
    }
    return output;
  }

  [[nodiscard]] VertexId place_of(std::uint32_t vertex) const {
    return corner_vertex(complex_, boundary_, corners_.vertex_corner[vertex], solid_);
  }

  [[nodiscard]] const Point& point_of(std::uint32_t vertex) const {
    return complex_.vertices[place_of(vertex)];
  }

  const CellComplex& complex_;
  const IdVector<FacetId, Cover>& cover_;
  const std::vector<char>& solid_;
  const Boundary& boundary_;
  const ManifoldCorners& corners_;
  const internal::MergedFacets& merged_;
  const MiddleVertices& middles_;
  const std::vector<char>& alone_;
  const InputPoints& input_points_;
  Surface surface_;
  std::vector<std::uint32_t> output_vertex_, output_middle_;
  std::vector<std::uint32_t> failed_, region_of_triangle_;
  IdVector<PointId, VertexId> taken_by_;  // of the points of the input, in a loose complex
  std::vector<internal::PolygonCorner> corner_list_;
  std::vector<std::uint32_t> vertex_list_;
  std::vector<std::array<std::uint32_t, 3>> pieces_;
};

// In a loose complex: merges what can be merged. Each round sets apart the polygons of the regions
// that went wrong; with all polygons apart nothing can, as every edge is then one of the complex,
// or half of one whose ends another one has too, or leads to the middle of one polygon.
class LooseExtractor {
 public:
  LooseExtractor(const CellComplex& complex, const IdVector<FacetId, Cover>& cover,
                 const std::vector<char>& solid, MergedBoundary parts)
      : complex_(complex),
        cover_(cover),
        solid_(solid),
        input_points_(complex.soup()),
        parts_(std::move(parts)) {
    parts_.alone.assign(parts_.boundary.polygons(), 0);
  }

  Surface run(ExtractReport& report, ProgressObserver* progress) {
    for (std::size_t round = 0;; ++round) {
      if (round == kMostRounds) set_all_apart();
      merge();
      SurfaceExtractor extractor(complex_, cover_, solid_, parts_, input_points_);
      Surface surface = extractor.run(report, progress);
      report.polygons_apart =
          static_cast<std::size_t>(std::count(parts_.alone.begin(), parts_.alone.end(), 1));
      // Where a region is missing, its neighbours' edges are open, so the conflicts come after.
      if (set_apart(extractor.failed()) || set_apart(conflicts_of(surface, extractor))) continue;
      if (round < kMostRounds && !is_manifold(surface)) {
        set_all_apart();
        continue;
      }
      return surface;
    }
  }

 private:
  static constexpr std::size_t kMostRounds = 8;

  static std::vector<std::uint32_t> conflicts_of(const Surface& surface,
                                                 const SurfaceExtractor& extractor) {
    return internal::conflicting_regions(surface.mesh.triangles, extractor.region_of_triangle());
  }

  void merge() {
    for (std::size_t round = 0;; ++round) {
      if (round == kMostRounds) set_all_apart();
      parts_.merged = internal::merge_facets(complex_, cover_, solid_, parts_.boundary,
                                             parts_.corners, parts_.alone, parts_.merges_triangles);
      if (!internal::set_apart_odd_regions(parts_.boundary, parts_.corners, parts_.merged,
                                           parts_.alone)) {
        break;
      }
    }
    parts_.middles = separate_common_edges(complex_, parts_.boundary, parts_.corners);
    internal::separate_common_ends(parts_.boundary, parts_.corners, parts_.merged, parts_.middles);
  }

  // Edges alone do not tell of two fans at one vertex.
  static bool is_manifold(const Surface& surface) {
    return examine_topology(surface.mesh.triangles, surface.mesh.points.size()).manifold();
  }

  void set_all_apart() { std::fill(parts_.alone.begin(), parts_.alone.end(), 1); }

  // False when they all were so already.
  bool set_apart(const std::vector<std::uint32_t>& regions) {
    bool any = false;
    for (const std::uint32_t r : regions) {
      for (const std::uint32_t p : parts_.merged.polygons_of(r)) {
        any |= parts_.alone[p] == 0;
        parts_.alone[p] = 1;
      }
    }
    return any;
  }

  const CellComplex& complex_;
  const IdVector<FacetId, Cover>& cover_;
  const std::vector<char>& solid_;
  InputPoints input_points_;
  MergedBoundary parts_;
};

}  // namespace

Surface extract_surface(const CellComplex& complex, const IdVector<FacetId, Cover>& cover,
                        const std::vector<char>& solid, ExtractReport& report,
                        const ExtractOptions& options) {
  MergedBoundary parts;
  parts.boundary = find_boundary(complex, solid);
  parts.corners =
      cut_nonmanifold(complex, parts.boundary, solid, options.touching, options.progress);
  parts.merges_triangles = options.merges_triangles;
  if (complex.loose) {
    return LooseExtractor(complex, cover, solid, std::move(parts)).run(report, options.progress);
  }
  parts.merged = internal::merge_facets(complex, cover, solid, parts.boundary, parts.corners, {},
                                        options.merges_triangles);
  parts.middles = separate_common_edges(complex, parts.boundary, parts.corners);
  const InputPoints input_points(complex.soup());
  return SurfaceExtractor(complex, cover, solid, parts, input_points).run(report, options.progress);
}

}  // namespace meshrepair
