#include <bsp/predicates.h>
#include <extract/boundary.h>
#include <extract/cut_nonmanifold.h>
#include <extract/extract_surface.h>
#include <extract/triangulate.h>

#include "input_points.h"

namespace meshrepair {
namespace {

class SurfaceExtractor {
 public:
  SurfaceExtractor(const CellComplex& complex, const IdVector<FacetId, Cover>& cover,
                   const std::vector<char>& solid)
      : complex_(complex), cover_(cover), solid_(solid) {}

  Surface run(ExtractReport& report) {
    boundary_ = find_boundary(complex_, solid_);
    corners_ = cut_nonmanifold(complex_, boundary_, solid_);
    place_vertices();
    for (std::uint32_t p = 0; p < boundary_.polygons(); ++p) triangulate(p);
    report = {boundary_.polygons(), corners_.singular_edges, corners_.singular_vertices,
              corners_.middle_side.size()};
    return std::move(surface_);
  }

 private:
  void place_vertices() {
    const internal::InputPoints input(complex_.soup());
    auto& points = surface_.mesh.points;
    points.reserve(corners_.vertices());
    for (const std::uint32_t side : corners_.vertex_corner) {
      const Point& at = complex_.vertices[corner_vertex(complex_, boundary_, side, solid_)];
      points.push_back(input.place(at, complex_.planes));
    }
    for (const std::uint32_t side : corners_.middle_side) {
      points.push_back(0.5 * points[corners_.vertex[side]] +
                       0.5 * points[corners_.vertex[boundary_.next(side)]]);
    }
  }

  void triangulate(std::uint32_t polygon) {
    corner_list_.clear();
    vertex_list_.clear();
    for (std::uint32_t s = boundary_.first[polygon]; s < boundary_.first[polygon + 1]; ++s) {
      const Vec3d& at = surface_.mesh.points[corners_.vertex[s]];
      corner_list_.push_back({{at.x(), at.y(), at.z()}, is_straight(polygon, s)});
      vertex_list_.push_back(corners_.vertex[s]);
      if (corners_.middle[s] == ManifoldCorners::kNone) continue;
      const Vec3d& middle = surface_.mesh.points[corners_.middle[s]];
      corner_list_.push_back({{middle.x(), middle.y(), middle.z()}, true});
      vertex_list_.push_back(corners_.middle[s]);
    }
    triangles_.clear();
    triangulate_convex(corner_list_, triangles_);
    const TriangleId covering = cover_[boundary_.facet[polygon]].triangle;
    const std::uint32_t source =
        covering.valid() ? complex_.soup().triangles[covering].source : Surface::kNoSource;
    for (const auto& t : triangles_) {
      surface_.mesh.triangles.push_back(
          {vertex_list_[t[0]], vertex_list_[t[1]], vertex_list_[t[2]]});
      surface_.source.push_back(source);
    }
  }

  // Whether the corner at the start of side s lies on the straight line from its neighbours.
  [[nodiscard]] bool is_straight(std::uint32_t polygon, std::uint32_t s) const {
    const std::uint32_t before =
        s > boundary_.first[polygon] ? s - 1 : boundary_.first[polygon + 1] - 1;
    const PlaneId line = complex_.side_plane(complex_.uses[boundary_.use[before]]);
    const VertexId after = corner_vertex(complex_, boundary_, boundary_.next(s), solid_);
    return side(complex_.vertices[after], line, complex_.planes) == 0;
  }

  const CellComplex& complex_;
  const IdVector<FacetId, Cover>& cover_;
  const std::vector<char>& solid_;
  Boundary boundary_;
  ManifoldCorners corners_;
  Surface surface_;
  std::vector<PolygonCorner> corner_list_;
  std::vector<std::uint32_t> vertex_list_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
};

}  // namespace

Surface extract_surface(const CellComplex& complex, const IdVector<FacetId, Cover>& cover,
                        const std::vector<char>& solid, ExtractReport& report) {
  return SurfaceExtractor(complex, cover, solid).run(report);
}

}  // namespace meshrepair
