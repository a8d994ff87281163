// SPDX-License-Identifier: MIT
// Everything that is wrong with a mesh as the boundary of a solid.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <base/progress.h>
#include <check/self_intersections.h>
#include <mesh/soup.h>

namespace meshrepair {

// Triangles with a repeated corner and those that are not finite are left out of all the rest.
// Those whose corners lie on a line are not: they may close a surface.
enum class Defect {
  open_edge,            // with one triangle
  nonmanifold_edge,     // with more than two
  inconsistent_edge,    // with two that pass it in the same direction
  nonmanifold_vertex,   // with several fans of triangles
  degenerate_triangle,  // without an area: corners repeated, or on a line
  not_finite_triangle,  // with a coordinate that is infinite or no number
  duplicate_triangle,   // with corners in the same places as one before, either way round
  self_intersection,    // two triangles that meet beyond what they share (self_intersections.h)
  inside_out_part,      // a closed part that faces what it should enclose
  unused_point,         // of no triangle; no fault of the surface
};
inline constexpr std::size_t kDefects = 10;

// "open_edges", "self_intersections", ...: keys of reports.
[[nodiscard]] std::string_view defect_name(Defect defect);

struct Place {
  // Points for edges and points, triangles for triangles, the part's first triangle for a part; the
  // second equals the first where there is one.
  std::array<std::uint32_t, 2> ids{};
  Vec3d at = Vec3d::Zero();  // the middle of it; NaN of what is not finite
};

struct DefectPlaces {
  std::size_t count = 0;
  std::vector<Place> first;  // of them, by ids
};

// Connected through edges.
struct SurfacePart {
  std::size_t triangles = 0;
  std::uint32_t first_triangle = 0;
  bool closed = false;      // each edge is passed as often one way as the other
  std::uint32_t depth = 0;  // the number of closed parts around it; 0 for those not closed
  int facing = 0;           // of a closed one: 1 outward, -1 inward, 0 encloses nothing; exact
  bool inside_out = false;
  double volume = 0;  // signed; of what is closed
  double area = 0;
};

struct CheckOptions {
  bool weld = false;             // points with equal coordinates are one: joins what only touches
  std::size_t most_places = 10;  // of each defect
  bool mark_triangles = false;   // fills SurfaceCheck::marks
  ProgressObserver* progress = nullptr;  // not owned; stages "edges", "crossings", "parts"
};

struct SurfaceCheck {
  std::size_t points = 0;
  std::size_t triangles = 0;
  std::size_t edges = 0;
  std::array<DefectPlaces, kDefects> defects;
  SelfIntersections self_intersections;  // its pairs only as far as they are needed
  std::vector<SurfacePart> parts;        // by first triangle
  std::size_t cavities =
      0;              // closed parts inside an odd number of others; 0 if the mesh crosses itself
  double volume = 0;  // signed; means little where the mesh is not closed
  double area = 0;
  std::vector<std::uint16_t> marks;  // of each triangle: bit 1 << d is set for its Defect d

  [[nodiscard]] const DefectPlaces& operator[](Defect d) const {
    return defects[static_cast<std::size_t>(d)];
  }
  DefectPlaces& operator[](Defect d) { return defects[static_cast<std::size_t>(d)]; }

  [[nodiscard]] bool closed() const;
  [[nodiscard]] bool manifold() const;
  [[nodiscard]] bool oriented() const;
  // Every part is closed and faces away from what it encloses. Not where that cannot be told: at
  // edges that are not manifold, and where triangles intersect.
  [[nodiscard]] bool outward() const;
  // The boundary of a solid: all of the above, and no degenerate, infinite, duplicate or
  // intersecting triangle.
  [[nodiscard]] bool valid_solid() const;
};

// Shared corners are those of equal index (unless welded), only for self-intersections always those
// of equal coordinates: that parts touch in a point is no intersection. Edges and points in `ids`
// are numbered as in the soup. A part that crosses others is called inside out only if it surely
// is. Throws Cancelled. Exact; the same for any number of threads.
[[nodiscard]] SurfaceCheck check_surface(const TriangleSoup& soup,
                                         const CheckOptions& options = {});

}  // namespace meshrepair
