// SPDX-License-Identifier: MIT
// A wall is made of pieces, each the surface of a body that does not turn itself inside out: so no
// place is wound around the wrong way, and what is wound around at all is their union, however they
// lie to each other.
//
// - Triangles whose corners are moved together, corner_offsets.h, make a wall of one piece: the
//   walls of triangles, which are upright each, less the sides that two of them have in common.
// - Where that would turn some over, as the sheet is curved more than the wall is thick, they go
//   less far there, and what lies in a plane has a wall of its own, too, that stands upright on it:
//   own_walls.h.
// - Where the walls of neighbours do not end in the same four points, a convex piece goes around
//   their edge: fold_walls.h.
// - Where several of these meet, another one goes around the point: corner_walls.h.
//
// All pieces are inside what is as far from the sheet as they are, but for kMostBeside.
#include <algorithm>
#include <array>
#include <utility>

#include <exact/double_predicates.h>
#include <repair/thicken_sheets.h>

#include "corner_offsets.h"
#include "corner_walls.h"
#include "fold_walls.h"
#include "own_walls.h"
#include "sheet_mesh.h"

namespace meshrepair {
namespace {

using internal::CornerOffsets;
using internal::SheetMesh;
using internal::SheetSide;
using internal::WallReach;

WallReach reach_of(double thickness, ThickenSide side) {
  if (side == ThickenSide::outside) return {0, thickness};
  if (side == ThickenSide::inside) return {thickness, 0};
  return {thickness / 2, thickness / 2};
}

class TriangleWalls {
 public:
  TriangleWalls(const SheetMesh& mesh, const CornerOffsets& offsets, SheetWalls& walls)
      : mesh_(mesh), offsets_(offsets), walls_(walls) {
    std::vector<Vec3d>& points = walls_.soup.points;
    points.resize(2 * offsets_.vectors.size(), Vec3d::Zero());
    for (std::uint32_t corner = 0; corner < offsets_.of_corner.size(); ++corner) {
      const Vec3d& vector = offsets_.vectors[offsets_.of_corner[corner]];
      points[low(corner)] = mesh_.at(corner) - offsets_.reach_at(corner, SheetSide::below) * vector;
      points[high(corner)] =
          mesh_.at(corner) + offsets_.reach_at(corner, SheetSide::above) * vector;
    }
  }

  void run() {
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (offsets_.has_wall[t] == 0) continue;
      add(t, {high(3 * t), high(3 * t + 1), high(3 * t + 2)});
      add(t, {low(3 * t), low(3 * t + 2), low(3 * t + 1)});
      for (std::uint32_t side = 3 * t; side < 3 * t + 3; ++side) {
        if (!offsets_.goes_on(mesh_, side)) close(side);
      }
    }
  }

 private:
  [[nodiscard]] std::uint32_t low(std::uint32_t corner) const {
    return 2 * offsets_.of_corner[corner];
  }
  [[nodiscard]] std::uint32_t high(std::uint32_t corner) const { return low(corner) + 1; }

  void add(std::uint32_t t, const std::array<std::uint32_t, 3>& corners) {
    walls_.soup.triangles.push_back(corners);
    walls_.source.push_back(mesh_.source[t]);
  }

  // Along the diagonal that bends outward, so that nothing is left between this and what goes
  // around the edge.
  void close(std::uint32_t side) {
    const std::uint32_t t = side / 3, next = next_side(side);
    const std::vector<Vec3d>& at = walls_.soup.points;
    if (orientation(at[low(side)], at[low(next)], at[high(next)], at[high(side)]) <= 0) {
      add(t, {low(side), low(next), high(next)});
      add(t, {low(side), high(next), high(side)});
    } else {
      add(t, {low(side), low(next), high(side)});
      add(t, {low(next), high(next), high(side)});
    }
  }

  const SheetMesh& mesh_;
  const CornerOffsets& offsets_;
  SheetWalls& walls_;
};

}  // namespace

std::string_view thicken_side_name(ThickenSide side) {
  if (side == ThickenSide::outside) return "outside";
  return side == ThickenSide::inside ? "inside" : "middle";
}

SheetWalls thicken_sheets(const CleanSoup& soup, const std::vector<char>& is_sheet,
                          double thickness, ThickenSide side, ThickenReport& report,
                          ProgressObserver* progress) {
  const WallReach reach = reach_of(thickness, side);
  CancelCheck cancel(progress);
  const SheetMesh mesh = internal::make_sheet_mesh(soup, is_sheet);
  cancel.ask();
  const CornerOffsets offsets = internal::find_corner_offsets(mesh, reach);
  cancel.ask();
  SheetWalls walls;
  TriangleWalls(mesh, offsets, walls).run();
  internal::append_own_walls(mesh, offsets, reach, walls);
  internal::append_corners(mesh, reach, internal::append_folds(mesh, offsets, reach, walls, report),
                           walls, report);
  report.thickness = thickness;
  report.side = side;
  report.triangles = mesh.triangles.size();
  report.sheets = mesh.sheets;
  report.area = mesh.area;
  report.wall_triangles = walls.soup.triangles.size();
  return walls;
}

}  // namespace meshrepair
