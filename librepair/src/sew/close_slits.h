// SPDX-License-Identifier: MIT
// Open edges that lie on each other, but end at other corners: slits without a gap, which dropping
// triangles without area leaves.
#pragma once

#include <cstddef>

#include <base/progress.h>
#include <bsp/clean_soup.h>

namespace meshrepair::internal {

// Where a triangle without area was dropped, its neighbour has the long edge and the others have
// the two short ones: a slit, without a gap. Triangles with such an edge get the corners on it, so
// that none is open any more. Only where all of a slit closes so, in a few pieces, of which none is
// there already, and where no other edge is open at its corners. Exact on the working grid: no
// place is covered anew, none is left. The order of triangles stays, by their sources. Returns how
// many slits it closed. n log n in the open edges, besides passes over all. Throws Cancelled.
std::size_t close_slits(CleanSoup& soup, ProgressObserver* progress = nullptr);

// Triangles that are cancelled out go, with points that no other one has: they are walls without
// inside, as rounding makes them of thin ones. Triangles that became lines are gone already, and
// have left edges that lie on each other, but end at different corners: one neighbour has the whole
// edge, others have parts of it. Triangles on such edges are cut at all these corners, and copies
// that come of it count as one, or cancel out. So the surface covers what it did, and at each edge
// as many triangles, with their layers, run one way as the other, if that was so before they came
// onto the grid. Returns whether it is so; else the soup is changed as far as that went. All
// triangles have a source. Linear in the triangles, n log n in edges left open. Throws Cancelled.
bool zip_edges(CleanSoup& soup, ProgressObserver* progress = nullptr);

// Drops triangles as many copies of which are turned one way as the other, and points that no other
// one has: where all triangles are turned rightly, such are walls without inside, as rounding makes
// them of thin ones. What was closed stays so. Returns how many triangles went. Linear.
std::size_t drop_cancelled(CleanSoup& soup);

}  // namespace meshrepair::internal
