// Open edges that lie on each other, but end at other corners.
#pragma once

#include <cstddef>

#include <base/progress.h>
#include <bsp/clean_soup.h>

namespace meshrepair {

// Where a triangle without area was dropped, its neighbour has the long edge and the others have
// the two short ones: a slit, without a gap. Triangles with such an edge get the corners on it, so
// that none is open any more. Only where all of a slit closes so, in a few pieces, of which none is
// there already, and where no other edge is open at its corners. Exact on the working grid: no
// place is covered anew, none is left. The order of triangles stays, by their sources. Returns how
// many slits it closed. n log n in the open edges, besides passes over all. Throws Cancelled.
std::size_t close_slits(CleanSoup& soup, ProgressObserver* progress = nullptr);

}  // namespace meshrepair
