// SPDX-License-Identifier: MIT
// What became of the input's triangles and parts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <bsp/clean_soup.h>
#include <extract/cell_complex.h>
#include <extract/cover_facets.h>
#include <extract/surface.h>

namespace meshrepair {

struct PartsAndArea {
  std::size_t parts = 0;
  double area = 0;  // of the parts, in the input's units, squared
};

// A part is what is connected through edges, patches over holes included.
struct PartFates {
  PartsAndArea enclosing_nothing;  // not a piece bounds the solid, and some lies outside it
  PartsAndArea inside_solid;       // not a piece bounds the solid, and all lies inside it
  std::size_t closed_inside = 0;   // of these: without an open edge; voids by another rule
  // Triangles of the input: of which a piece bounds the solid; that lie inside it with all pieces;
  // the others, which lie outside it, or coincide with another triangle.
  std::size_t bounding_triangles = 0;
  std::size_t inside_triangles = 0;
  std::size_t outside_triangles = 0;
  // Of each triangle of the clean soup, where its pieces lie, as below; empty if that is not known,
  // as where all bound the solid for sure.
  std::vector<std::uint8_t> places;
};

// Where the pieces of a triangle lie: bits; none of them where it has no piece of its own.
inline constexpr std::uint8_t kOnBoundary = 1;
inline constexpr std::uint8_t kInside = 2;
inline constexpr std::uint8_t kOutside = 4;
// Beside kOnBoundary: of a sheet that was thickened, whose walls bound the solid.
inline constexpr std::uint8_t kThickened = 8;

// Of each triangle of the soup the places of all its pieces among the facets, those where several
// coincide only for the first. `solid` has one entry for each cell.
[[nodiscard]] std::vector<std::uint8_t> places_of_triangles(const CellComplex& complex,
                                                            const IdVector<FacetId, Cover>& cover,
                                                            const std::vector<char>& solid);

// `places` are those of each triangle. Linear but for parts that were removed, for which edges are
// sorted.
[[nodiscard]] PartFates find_part_fates(const CleanSoup& soup,
                                        const std::vector<std::uint8_t>& places);

// For each triangle of the surface whether it is one of the input, with its own coordinates.
[[nodiscard]] std::vector<char> find_whole_triangles(const CleanSoup& input,
                                                     const Surface& surface);

// Of the input's triangles.
struct TriangleFates {
  std::size_t untouched = 0;  // came out with their own coordinates, bit for bit
  std::size_t cut = 0;        // came out in part, in several pieces, merged with others, or moved
  std::size_t rounded = 0;    // of these: whole, but for rounding to single precision; of repair()
};

[[nodiscard]] TriangleFates find_triangle_fates(const CleanSoup& input, const PartFates& parts,
                                                const Surface& surface);

}  // namespace meshrepair
