// SPDX-License-Identifier: MIT
// Several soups on one grid, so that what is made of them can be compared exactly.
#pragma once

#include <span>

#include <base/progress.h>
#include <bsp/clean_soup.h>
#include <exact/grid.h>
#include <mesh/soup.h>

namespace meshrepair {

// The grid for all corners of these soups, but for triangles that are not finite.
[[nodiscard]] Grid make_grid(std::span<const TriangleSoup* const> soups);

// As clean_soup() without a grid; this one is made for a box that holds all finite corners.
[[nodiscard]] CleanSoup clean_soup(const TriangleSoup& soup, const Grid& grid, CleanReport& report,
                                   ProgressObserver* progress = nullptr);

}  // namespace meshrepair
