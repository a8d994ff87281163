// SPDX-License-Identifier: MIT
// Where walls, pins, gaps and edges are thinner than a given length.
//
// The thickness at a point p of a triangle with the unit normal n is the diameter of the largest
// ball that touches the triangle at p from behind (its centre is p - r n) and contains no point of
// a triangle that faces p. A triangle with the unit normal m faces p if p is behind it, and
//
//   cos(n, m) <= -0.9    wall: within 26 degrees of opposite
//   cos(n, m) <= -0.4    edge: within 66 degrees of opposite; only where there is no thin wall
//
// So the faces of a wedge face each other if its angle is at most 66 degrees. It is thin near its
// tip; the edges of a cube are not. Triangles that face elsewhere do not limit the ball: neither
// the neighbours in a smooth surface, nor the rim of a plate. But where a triangle within 45
// degrees of the direction of the tip is in the ball of an edge, the tip is cut off, and there is
// no edge: so the faces of a bar with six sides are none. For a gap the ball is in front of the
// triangles, its centre is p + r n, and the condition is that of a wall.
//
// If another triangle crosses the segment between p and the point where the ball touches the second
// triangle, there is no wall, and no gap.
//
// A wall or an edge is a pin if it is thin the other way, too. That way is at right angles to n,
// along the normal of the triangle that is nearest to the centre of the ball, of those at least 45
// degrees off n, or at right angles to both. The line through the centre has to leave the
// solid on both sides, through triangles that face each other as those of an edge do, within less
// than the limit; and neither the thickness nor this width is more than four times the other one.
//
// Ma, Bae and Choi, 3D medial axis point approximation using nearest neighbors and the normal
// field (2012), have the balls; here each triangle gives the size of its ball in closed form.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <base/progress.h>
#include <mesh/soup.h>

namespace meshrepair {

enum class ThinKind { wall, pin, gap, edge };
inline constexpr std::size_t kThinKinds = 4;

// Connected, of one kind. Units are those of the soup.
struct ThinPlace {
  Vec3d at = Vec3d::Zero();    // the sample where it is thinnest, but for the least area
  std::uint32_t triangle = 0;  // in which that lies
  double thickness = 0;        // there
  double area = 0;             // of the surface; of a wall that of both sides
};

struct ThinPlaces {
  std::size_t count = 0;
  double area = 0;
  std::vector<ThinPlace> first;  // the thinnest first
};

struct ThinOptions {
  double limit = 0;                      // what is thinner is looked for; above 0
  bool is_share = false;                 // the limit is a share of the diagonal of the bounding box
  std::size_t most_places = 10;          // of each kind
  bool mark_triangles = false;           // fills ThinReport::marks
  ProgressObserver* progress = nullptr;  // not owned; stage "thickness"
};

struct ThinReport {
  double limit = 0;      // in units of the soup
  double spacing = 0;    // of samples: no point of a triangle is farther from one than 2/3 of it
  double area = 0;       // of all triangles
  double thin_area = 0;  // of what is thin in any way
  std::array<ThinPlaces, kThinKinds> kinds;
  std::vector<std::uint8_t> marks;  // of each triangle: bit k is set if some of it is of ThinKind k

  [[nodiscard]] const ThinPlaces& operator[](ThinKind kind) const {
    return kinds[static_cast<std::size_t>(kind)];
  }
};

// Measures at the middle of each triangle. A triangle with an edge longer than half the limit is
// bisected first, where something may be thin; a sample stands for the area of its piece. So a thin
// place that has a disk of a third of the limit as its radius in one triangle is found. Beyond two
// million pieces the spacing is twice as large, or four times, and so on; ThinReport::spacing says
// it.
//
// Pieces of one kind are connected where they share a corner, or where the ball at the one touches
// the other. The least area of a place is 0.01 limit^2, but at most a thousandth of the surface.
// Smaller places are left out, and where a place is thinnest, as much of its area is passed over:
// many meshes have folded slivers, which are thinner than all that matters.
//
// The soup need not be closed: what is told is about the triangles that are there. Triangles
// without an area, or not finite, are left out. Faces that are nearer than the rounding of their
// coordinates count as one, and not as thin.
//
// A thickness may be a thousandth too large. Numbers are the same for any number of threads, any
// order of triangles, and if the soup is moved without rounding or scaled by a power of two. n log
// n but for pairs of triangles that are nearer than the limit. Throws Cancelled.
[[nodiscard]] ThinReport find_thin_places(const TriangleSoup& soup, const ThinOptions& options);

}  // namespace meshrepair
