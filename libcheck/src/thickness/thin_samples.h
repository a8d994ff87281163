// SPDX-License-Identifier: MIT
// The samples at which something is thin, and how they are connected.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <check/thin_places.h>

#include "facing_triangles.h"
#include "triangle_piece.h"

namespace meshrepair::internal {

struct ThinSample {
  std::array<Vec3d, 3> corners;  // of its piece
  std::uint64_t path = 0;        // likewise
  double area = 0;               // likewise
  Vec3d at = Vec3d::Zero();
  std::uint32_t triangle = 0;  // a position in FacingTriangles::triangles()
  ThinKind kind = ThinKind::wall;
  Contact contact;
  bool is_told = true;
};

// By triangle, path and kind.
using ThinSamples = std::vector<ThinSample>;

// The sum does not depend on their order.
[[nodiscard]] double sum_of(std::vector<double> values);

// All of one kind, the thinnest first; areas and lengths as in the samples. `square` is that of
// TrianglePiece::is_to_halve(). The samples of places with less than `least_area` are told no more;
// so much of the area of the others is no thicker than they say.
[[nodiscard]] std::vector<ThinPlace> find_places(ThinKind kind, ThinSamples& samples,
                                                 std::span<const MeasuredTriangle> triangles,
                                                 double square, double least_area);

}  // namespace meshrepair::internal
