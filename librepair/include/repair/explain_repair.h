// SPDX-License-Identifier: MIT
// What became of each triangle of the input, and where each of the result comes from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <extract/surface.h>
#include <mesh/soup.h>

namespace meshrepair {

struct RepairOptions;
struct RepairReport;

// Of a triangle of the input. The first that holds.
enum class TriangleFate : std::uint8_t {
  left_out,   // of a solid that was to go, or the wall of a void that was filled
  thickened,  // a wall was made of it
  turned,     // in the result, whole or in pieces, the other way round
  whole,      // in the result, with its own corners
  cut,        // in the result in pieces, or merged with others
  moved,      // the same, and corners were sewn to others before
  inside,     // all of it lies inside the solid
  duplicate,  // it lies where others lie
  dropped,    // without area, smaller than the working grid, or with no finite coordinates
  outside,    // it bounds nothing
};
inline constexpr std::size_t kTriangleFates = 10;

// Of a triangle of the result.
enum class TriangleOrigin : std::uint8_t {
  whole,  // one of the input
  piece,  // lies in one of the input, or in several of one plane
  wall,   // of a sheet that was thickened; or, after hollow(), of a cavity or a drain
  patch,  // of no triangle of the input: it closes a hole or a gap
  seal,   // the same, over an opening that was sealed
};
inline constexpr std::size_t kTriangleOrigins = 5;

// "whole", "left_out".
[[nodiscard]] std::string_view fate_name(TriangleFate fate);
[[nodiscard]] std::string_view origin_name(TriangleOrigin origin);

struct RepairExplanation {
  std::vector<TriangleFate> fates;      // of each triangle of the input
  std::vector<TriangleOrigin> origins;  // of each triangle of the result
};

// Pre: `surface` and `report` are what repair() made of the soup with these options, which ask for
// all parts, and for no openings to be sealed. Cleans and sews the soup once more. n log n. Throws
// Cancelled.
[[nodiscard]] RepairExplanation explain_repair(const TriangleSoup& soup, const Surface& surface,
                                               const RepairOptions& options,
                                               const RepairReport& report);

// Of the triangles of a surface that was made of such a soup, where what became of it is known: no
// seal among them. Linear.
[[nodiscard]] std::vector<TriangleOrigin> find_origins(const TriangleSoup& soup,
                                                       const std::vector<TriangleFate>& fates,
                                                       const Surface& surface);

// Where only some triangles of that surface are to stay: nothing if it is not explained. Pre:
// `surface` has them all yet. Linear.
void leave_out(const Surface& surface, const std::vector<char>& stays,
               RepairExplanation& explanation);

}  // namespace meshrepair
