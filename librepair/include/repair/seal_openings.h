// Openings that a ball cannot pass.
#pragma once

#include <cstddef>

#include <base/progress.h>
#include <bsp/clean_soup.h>

namespace meshrepair {

struct SealOptions {
  double size = 0;        // diameter of the ball, in the soup's unit; 0: nothing is sealed
  bool is_share = false;  // it is a share of the diagonal of the bounding box instead
  // Of the grid that space is looked at with. More than an eighth only where openings need it.
  std::size_t most_cubes = std::size_t{1} << 23;
};

struct SealReport {
  double size = 0;            // in the soup's unit
  double step = 0;            // of the grid that space was looked at with, in the soup's unit
  std::size_t openings = 0;   // that were closed
  std::size_t triangles = 0;  // of patches over them
  double filled_volume = 0;   // that is solid since, in the soup's unit, cubed
};

// Adds triangles with Triangle::source kNoSource and winding 0 that close the openings through
// which a ball of this diameter, rolling around the surface from outside, does not come. What lies
// behind is as if it were inside; nothing that is there is changed.
//
// A place is behind an opening if the way to it, from where the ball comes, is longer than 0.3
// times what the nearest wall is away from it, and space does not widen around it: there walls are
// nowhere farther away by more than 0.45 times the way; and so is what is passed on the way. Thus
// fillets in concave edges of more than 55 degrees and in corners stay, and so do grooves and
// dishes that are less deep than about two thirds of their width. The patch lies two steps of the
// grid behind what the ball reaches.
//
// Space is looked at with a grid of cubes, 6 to 96 to the ball's diameter, as many as are cheap.
// Openings narrower than a cube may be missed; whether one is closed whose width differs by less
// than a step from the diameter is a matter of where the grid lies. Throws UsageError where even 6
// are more than may be, Cancelled.
void seal_openings(CleanSoup& soup, const SealOptions& options, SealReport& report,
                   ProgressObserver* progress = nullptr);

}  // namespace meshrepair
