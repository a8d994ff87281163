// SPDX-License-Identifier: MIT
// Which triangles are of sheets that become walls.
#pragma once

#include <cstdint>
#include <vector>

#include <bsp/clean_soup.h>

namespace meshrepair::internal {

// Of the input's triangles of which a piece lies outside what is solid, those that are connected,
// through others of them, with an edge that is open: patches over it that bound nothing do not
// count. And those of flat parts, as leaves are that have two faces. All else that encloses nothing
// is closed, and turned inside out there: it is no sheet. `places` are those of part_fates.h, of
// each triangle of the soup; empty: none is a sheet. A flag for each triangle.
[[nodiscard]] std::vector<char> find_sheets(const CleanSoup& soup,
                                            const std::vector<std::uint8_t>& places);

// Of the bounding box, in the soup's unit.
[[nodiscard]] double diagonal_of(const CleanSoup& soup);

// Of sheets, so thick that walls can be told from them, and are finer than what they show: a
// hundredth of the diagonal of the bounding box, or what half of the edges are longer than, if that
// is less; rounded to one digit. 0 if there are none.
[[nodiscard]] double fitting_thickness(const CleanSoup& soup, const std::vector<char>& is_sheet);

}  // namespace meshrepair::internal
