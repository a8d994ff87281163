// SPDX-License-Identifier: MIT
// Open sheets become walls.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <base/progress.h>
#include <bsp/clean_soup.h>
#include <mesh/soup.h>

namespace meshrepair {

// Where the sheet is in its wall. Outside is where its triangles face, most of those of a sheet.
enum class ThickenSide { middle, outside, inside };

[[nodiscard]] std::string_view thicken_side_name(ThickenSide side);

struct ThickenOptions {
  double thickness = 0;   // of walls, in the soup's unit; 0: sheets stay what they are
  bool is_share = false;  // it is a share of the diagonal of the soup's bounding box instead
  // A thickness that fits instead, where nothing is solid, or more than half of the area is of
  // parts that enclose nothing.
  bool automatic = false;
  ThickenSide side = ThickenSide::middle;
  // Holes of a larger share of their part are the rim of a sheet, whatever HoleOptions says:
  // whoever asks for walls has sheets. A half-ball has 1/2. Unless it is infinite,
  // HoleOptions::sheets_stay_open holds, too.
  double largest_hole_share = 0.25;

  [[nodiscard]] bool wanted() const { return automatic || thickness > 0; }
};

struct ThickenReport {
  double thickness = 0;    // in the soup's unit; 0: nothing was thickened
  bool automatic = false;  // it was found, not given
  ThickenSide side = ThickenSide::middle;
  std::size_t triangles = 0;       // of sheets
  std::size_t sheets = 0;          // connected through edges
  double area = 0;                 // of the sheets, in the soup's unit, squared
  std::size_t folds = 0;           // edges around which the wall is round
  std::size_t corners = 0;         // points around which it is
  std::size_t wall_triangles = 0;  // before walls were united
  double solid_volume = 0;         // of what was solid without walls
  // Where nothing is enclosed, a thickness that fits the mesh; 0 where it has no sheets.
  double fitting = 0;
};

// Closed surfaces that wind around the walls, all of them the same way: the union of the walls is
// what any of them winds around. They may cross each other, and themselves.
struct SheetWalls {
  TriangleSoup soup;
  std::vector<std::uint32_t> source;  // of each triangle that of the sheet beside it
};

// Makes walls of the triangles with a flag in `is_sheet`, which has one for each triangle.
//
// Both sides of a wall are in the planes of the sheet's triangles, moved along their normals by
// what `side` says of `thickness`, up to a share of kMostBeside. Where a sheet folds by less than
// 30 degrees, these planes are extended until they meet; around sharper folds the wall is round.
// Where a sheet is curved more than its wall is thick, each plane has a wall of its own. Rims are
// closed by strips that stand on the sheet; along an edge of triangles that are no sheet they are
// round.
//
// n log n. Throws Cancelled.
[[nodiscard]] SheetWalls thicken_sheets(const CleanSoup& soup, const std::vector<char>& is_sheet,
                                        double thickness, ThickenSide side, ThickenReport& report,
                                        ProgressObserver* progress = nullptr);

// How far the sides of a wall may be from where they should be, as a share of the thickness that is
// on their side.
inline constexpr double kMostBeside = 0.04;

}  // namespace meshrepair
