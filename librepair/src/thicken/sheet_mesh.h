// SPDX-License-Identifier: MIT
// The sheets of a soup as a mesh of their own, whose triangles are turned alike.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <bsp/clean_soup.h>
#include <mesh/edge_table.h>

namespace meshrepair::internal {

// How a side of a triangle is joined to another triangle of its sheet.
enum class Joint : char {
  rim,   // it is not: nothing else is at the edge
  same,  // to one that is turned alike
  seam,  // to one that is turned the other way, as a Moebius strip has it somewhere
  many,  // more than two triangles, or others than those of sheets and patches, are at the edge
};

// Sides are those of EdgeTable, as corners are: corner 3 t + k is where side 3 t + k begins.
struct SheetMesh {
  std::vector<Vec3d> points;  // of the whole soup
  std::vector<IndexTriangle> triangles;
  std::vector<std::uint32_t> source;   // of each triangle
  std::vector<Vec3d> normal;           // of each triangle, of length 1
  std::vector<Joint> joint;            // of each side
  std::vector<std::uint32_t> partner;  // of sides that are `same` or `seam`, the other one
  // Of edges that are `many` the sides, one edge after the other, and where each one begins, and
  // ends; and whether others than sheets are there, too.
  std::vector<std::uint32_t> many_sides, many_first;
  std::vector<char> many_with_others;
  std::size_t sheets = 0;  // connected through edges
  double area = 0;

  [[nodiscard]] const Vec3d& at(std::uint32_t corner) const {
    return points[triangles[corner / 3][corner % 3]];
  }
  // The third corner of the side's triangle.
  [[nodiscard]] const Vec3d& beyond(std::uint32_t side) const {
    return at(next_side(next_side(side)));
  }
};

// Of the triangles with a flag. Most of the area of a sheet stays turned as it is.
[[nodiscard]] SheetMesh make_sheet_mesh(const CleanSoup& soup, const std::vector<char>& is_sheet);

}  // namespace meshrepair::internal
