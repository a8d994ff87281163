// SPDX-License-Identifier: MIT
// How many layers of surface the copies of a triangle are.
#pragma once

#include <cstdint>
#include <span>

#include <bsp/clean_soup.h>

namespace meshrepair::internal {

// A triangle with copies. Both numbers are signed: above 0 as the corners of the first are turned.
struct CopiedTriangle {
  TriangleId triangle;
  std::int32_t facing = 0;  // as one face, listed several times: 1, 0 or -1
  std::int32_t layers = 0;  // as faces of their own
};

// Sets `winding` and `layers` of the copied triangles, and turns the corners of those that count
// against the first. A face that is there twice is mostly one face; but where closed surfaces
// overlap with a face in common, each has its own, and the edges around tell: they are balanced,
// passed as often one way as the other, with all layers. It is decided for each set of copied
// triangles that are connected through edges, then changed for single ones. All others have to have
// their winding; `copied` is without repetition. n log n.
void count_layers(CleanSoup& soup, std::span<const CopiedTriangle> copied);

}  // namespace meshrepair::internal
