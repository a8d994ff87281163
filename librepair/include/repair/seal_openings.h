// SPDX-License-Identifier: MIT
// Openings that a ball cannot pass.
#pragma once

#include <cstddef>

#include <base/progress.h>
#include <extract/surface.h>

namespace meshrepair {

// What to seal: openings of a solid through which a ball of this diameter, rolling around it from
// outside, does not come. What lies behind becomes solid; all walls before stay as they are.
//
// A place is behind an opening if the way to it, from where the ball comes, is longer than 0.3
// times what the nearest wall is away from it, and space does not widen around it: there walls are
// nowhere farther away by more than 0.45 times the way; and so is what is passed on the way. Thus
// fillets in concave edges of more than 55 degrees and in corners stay, and so do grooves and
// dishes that are less deep than about two thirds of their width.
//
// Openings are found with a grid of cubes, 6 to 48 to the ball's diameter, as many as are cheap: of
// all space, or, where that takes too many, of the places where walls face each other less than
// the diameter apart. Those narrower than a cube may be missed; whether one is closed whose width
// differs by less than a step from the diameter is a matter of where the grid lies. The patch is
// made of faces of cubes, the smallest that part what is behind, at most two steps behind what the
// ball reaches. That they do is decided exactly. Then it is flattened by up to a step. Bodies that
// are farther apart than twice the diameter, along some axis, are sealed one by one.
struct SealOptions {
  double size = 0;        // diameter of the ball, in the soup's unit; 0: nothing is sealed
  bool is_share = false;  // it is a share of the diagonal of the solid's bounding box instead
  // With 1/1024, 1/512, ... 1/8 of the diagonal in turn, openings are closed that are small beside
  // what they lead to, where all of these together are worth it (kWorthSealing).
  bool automatic = false;
  // Instead: bodies that are hollow by mistake become full. An inner wall follows the outer one,
  // and is joined to it around pinholes alone. Found on the surface, whatever its size; bottles,
  // drain holes and vents are left as they are. See docs/sealing.md.
  bool double_walls = false;
  // Of the grid. More than an eighth only where openings need it; where even 6 to the diameter are
  // more, the size is refused with a UsageError.
  std::size_t most_cubes = std::size_t{1} << 23;

  [[nodiscard]] bool wanted() const { return automatic || double_walls || size > 0; }
};

struct SealReport {
  bool automatic = false;        // the size was found, not given; 0 where there is none
  std::size_t double_walls = 0;  // bodies that were hollow by mistake, see SealOptions
  double size = 0;               // in the soup's unit; the largest of those found
  double step = 0;               // of the grid, in the soup's unit; the largest of all bodies
  std::size_t openings = 0;      // that were closed
  double patches_area = 0;       // over them, in the soup's unit, squared
  double filled_volume = 0;      // that is solid since, in the soup's unit, cubed
  // Spaces behind openings that stay open, as a way around leads into them that cubes do not show.
  std::size_t leaks = 0;
  // Bodies whose openings stay open, as walls that nearly coincide cannot be divided there.
  std::size_t cannot_cut = 0;
};

// A smaller share of the solid's volume behind openings is no reason to close them unasked.
inline constexpr double kWorthSealing = 0.01;

// What SealOptions::automatic would close of a solid, size 0 if nothing. Throws Cancelled.
[[nodiscard]] SealReport propose_seal(const Surface& solid,
                                      std::size_t most_cubes = SealOptions().most_cubes,
                                      ProgressObserver* progress = nullptr);

}  // namespace meshrepair
