// A surface that was closed before its points came onto the grid is closed there, too.
#pragma once

#include <base/progress.h>
#include <bsp/clean_soup.h>

namespace meshrepair {

// Triangles that are cancelled out go, with points that no other one has: they are walls without
// inside, as rounding makes them of thin ones. Triangles that became lines are gone already, and
// have left edges that lie on each other, but end at different corners: one neighbour has the whole
// edge, others have parts of it. Triangles on such edges are cut at all these corners, and copies
// that come of it count as one, or cancel out. So the surface covers what it did, and at each edge
// as many triangles, with their layers, run one way as the other, if that was so before they came
// onto the grid. Returns whether it is so; else the soup is changed as far as that went. All
// triangles have a source. Linear in the triangles, n log n in edges left open. Throws Cancelled.
bool zip_edges(CleanSoup& soup, ProgressObserver* progress = nullptr);

}  // namespace meshrepair
