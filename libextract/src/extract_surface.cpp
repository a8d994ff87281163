#include <algorithm>
#include <array>
#include <vector>

#include <extract/boundary.h>
#include <extract/cut_nonmanifold.h>
#include <extract/extract_surface.h>
#include <extract/merge_facets.h>
#include <extract/triangulate.h>

#include "input_points.h"
#include "region_triangulator.h"

namespace meshrepair {
namespace {

using internal::RegionTriangle;

constexpr std::uint32_t kNone = ManifoldCorners::kNone;

class SurfaceExtractor {
 public:
  SurfaceExtractor(const CellComplex& complex, const IdVector<FacetId, Cover>& cover,
                   const std::vector<char>& solid, const ExtractOptions& options)
      : complex_(complex),
        cover_(cover),
        solid_(solid),
        boundary_(find_boundary(complex, solid)),
        corners_(cut_nonmanifold(complex, boundary_, solid, options.touching, options.progress)),
        merged_(merge_facets(complex, cover, solid, boundary_, corners_)),
        middles_(separate_common_edges(complex, boundary_, corners_)),
        input_points_(complex.soup()),
        progress_(options.progress) {}

  Surface run(ExtractReport& report) {
    output_vertex_.assign(corners_.vertices(), kNone);
    output_middle_.assign(middles_.count, kNone);
    internal::RegionTriangulator triangulator(complex_, solid_, boundary_, corners_, merged_);
    std::vector<RegionTriangle> triangles;
    CancelCheck cancel(progress_);
    for (std::size_t region = 0; region < merged_.regions(); ++region) {
      cancel.tick();
      triangulator.run(region, triangles);
      add(triangles, cover_[boundary_.facet[merged_.polygons_of(region)[0]]].triangle);
    }
    report.boundary_facets = boundary_.polygons();
    report.regions = merged_.regions();
    report.unmerged_triangles = triangulator.unmerged_triangles();
    report.singular_edges = corners_.singular_edges;
    report.singular_vertices = corners_.singular_vertices;
    report.middle_vertices = middles_.count;
    return std::move(surface_);
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
      const Point& at = point_of(vertex);
      return at.is_lattice() && at.lattice() == complex_.soup().grid_points[corner];
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
      triangulate_convex(corner_list_, pieces_);
    } else {
      pieces_.push_back({0, 1, 2});
    }
    for (const auto& t : pieces_) {
      surface_.mesh.triangles.push_back(
          {vertex_list_[t[0]], vertex_list_[t[1]], vertex_list_[t[2]]});
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
      const PointId input = input_points_.find(at);
      output = add_point(
          input.valid() ? complex_.soup().points[input]
                        : complex_.soup().grid.from_grid(accurate_position(at, complex_.planes)),
          input.valid());
    }
    return output;
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

  [[nodiscard]] const Point& point_of(std::uint32_t vertex) const {
    return complex_
        .vertices[corner_vertex(complex_, boundary_, corners_.vertex_corner[vertex], solid_)];
  }

  const CellComplex& complex_;
  const IdVector<FacetId, Cover>& cover_;
  const std::vector<char>& solid_;
  Boundary boundary_;
  ManifoldCorners corners_;
  MergedFacets merged_;
  MiddleVertices middles_;
  internal::InputPoints input_points_;
  ProgressObserver* progress_;
  Surface surface_;
  std::vector<std::uint32_t> output_vertex_, output_middle_;
  std::vector<PolygonCorner> corner_list_;
  std::vector<std::uint32_t> vertex_list_;
  std::vector<std::array<std::uint32_t, 3>> pieces_;
};

}  // namespace

Surface extract_surface(const CellComplex& complex, const IdVector<FacetId, Cover>& cover,
                        const std::vector<char>& solid, ExtractReport& report,
                        const ExtractOptions& options) {
  return SurfaceExtractor(complex, cover, solid, options).run(report);
}

}  // namespace meshrepair
