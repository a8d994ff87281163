// SPDX-License-Identifier: MIT
// A tetrahedron that a wall passes: the wall's triangles in it, and what lies on either side.
//
// The wall meets each face of the tetrahedron in a line between two of its edges, or in two lines
// over a point within the face where the wall has a ridge (as in C. Ho et al., "Cubical marching
// squares", 2005). These lines are a loop around the tetrahedron; the wall is the cone over it from
// a point within, or one or two triangles. So walls of neighbours fit, and no two triangles
// intersect, wherever the points are within their edges, faces and tetrahedra.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "common/depth.h"
#include "common/prove_depth.h"

namespace meshrepair::internal {

// Where walls are: at this depth.
class WallFinder {
 public:
  // `error`: how far a wall may be beside it.
  WallFinder(const Depth& depth, double thickness, double error)
      : depth_(depth), thickness_(thickness), error_(error) {}

  [[nodiscard]] const Depth& depth() const { return depth_; }
  [[nodiscard]] double thickness() const { return thickness_; }

  // On the edge from a place in a cavity to one that is not, within it.
  [[nodiscard]] Place on_edge(const Place& in, const Place& out) const;
  // The ridge in this face of a wall that has these two points on its edges, if it has one and the
  // point is within the face.
  [[nodiscard]] std::optional<Place> in_face(const std::array<Vec3d, 3>& face, const Place& p,
                                             const Place& q) const;
  // The tip of a wall with this loop; within the tetrahedron.
  [[nodiscard]] Place in_cell(const std::array<Vec3d, 4>& cell, const std::vector<Place>& loop,
                              const std::vector<Place>& ridges) const;
  [[nodiscard]] double misfit(const Place& place) const;

 private:
  [[nodiscard]] Place at_depth(const Place& from, const Vec3d& to) const;

  const Depth& depth_;
  double thickness_, error_;
};

// Names of points on edges and faces, by the corners of these.
using EdgeKey = std::array<std::uint32_t, 2>;
using FaceKey = std::array<std::uint32_t, 3>;

struct CutCell {
  std::array<std::uint32_t, 4> corners{};  // so that the fourth sees the first three clockwise
  std::array<Place, 4> places;
  std::array<bool, 4> in{};  // in a cavity
};

// A point of a wall: a corner of its triangles.
struct WallPoint {
  std::uint32_t number = 0;  // of the point on an edge or in a face
  Place place;
};

class WallPoints {
 public:
  virtual ~WallPoints() = default;
  [[nodiscard]] virtual WallPoint on_edge(std::uint32_t in, std::uint32_t out) const = 0;
  [[nodiscard]] virtual std::optional<WallPoint> in_face(FaceKey face) const = 0;
};

inline constexpr std::uint32_t kTip = ~std::uint32_t{0};  // the number of a point within

struct WallInCell {
  // Counter-clockwise seen from the side that is in no cavity.
  std::vector<std::array<WallPoint, 3>> triangles;
  std::vector<Piece> in, out;  // of the tetrahedron
};

// Some corner is in a cavity, and some is not.
[[nodiscard]] WallInCell wall_in(const CutCell& cell, const WallPoints& points,
                                 const WallFinder& finder);

}  // namespace meshrepair::internal
