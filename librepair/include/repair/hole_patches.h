// SPDX-License-Identifier: MIT
// Triangles over the holes of a soup.
#pragma once

#include <cstddef>
#include <string_view>

#include <base/progress.h>
#include <bsp/clean_soup.h>

namespace meshrepair {

enum class HoleMode {
  patch,   // triangles close the holes; what stays open is as with `extend`
  curved,  // the same, also where a patch leaves the bounding box of the rest
  flat,    // the same, between the points of each rim alone
  extend,  // the optimisation closes gaps along planes that are there (WM)
  none,    // what is not sealed off by the triangles alone is outside
};

[[nodiscard]] std::string_view hole_mode_name(HoleMode mode);

struct HoleOptions {
  HoleMode mode = HoleMode::patch;
  // A patch is at most this share of the area of all else of its part, other patches and rings
  // included: an open sheet is not a solid with a hole. A half-ball without its disk has 1/2, a
  // cone of 45 degrees without its base 0.71; the patch of a flat sheet has the sheet's area.
  double largest_share = 0.75;
  // The same for patches that lie in a plane: hills and dishes have them.
  double largest_flat_share = 0.95;
  // Rims of sheets stay open. Such are loops at which the surface arrives steeply, where a sheet
  // has two or more: the ends of a tube, unless the patch has less than 0.2 % of the sheet's area.
  // And loops that are as long as the rim of a flat disk of the sheet's area.
  bool sheets_stay_open = false;
  bool rings = true;  // may join two loops that face each other
  // Loops of more edges than this are cut along short chords before they are triangulated.
  std::size_t most_edges = 200;
};

struct HoleReport {
  std::size_t loops = 0;         // closed walks of edges at which an odd number of triangles meet
  std::size_t closed = 0;        // of these
  std::size_t curved = 0;        // of the closed ones: by patches with points of their own
  std::size_t rings = 0;         // between two of these
  std::size_t slits = 0;         // open edges that lie on each other: there is no gap
  std::size_t too_large = 0;     // left open, as the options say, or because
                                 // the patch would lie on the surface
  std::size_t stray_edges = 0;   // such edges on no loop
  std::size_t triangles = 0;     // added
  double area = 0;               // of these, in the input's units, squared
  double largest_area = 0;       // of one patch
  std::size_t longest_loop = 0;  // in edges, of the closed ones
};

// Adds triangles with Triangle::source kNoSource that close the holes: over each loop a
// triangulation of its own points, of little area and with few folds, and where the surface around
// it is curved, with HoleMode::patch and `curved`, one with new points that goes on as the surface
// does (Liepa 2003). A loop is found whatever the orientation of the triangles around it, and also
// where three or more meet at an edge. Two loops that face each other across a gap, as the rims of
// a missing ring or of two halves do, are joined by a ring where that has less area than two
// patches. Patches may cross anything. Does nothing if options.mode is `extend` or `none`. Throws
// UsageError where the share is not a number from 0 on, Cancelled.
void patch_holes(CleanSoup& soup, const HoleOptions& options, HoleReport& report,
                 ProgressObserver* progress = nullptr);

}  // namespace meshrepair
