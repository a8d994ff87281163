// Openings that a ball cannot pass.
#pragma once

#include <cstddef>
#include <vector>

#include <base/progress.h>
#include <mesh/soup.h>

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
// Openings are found with a grid of cubes, 6 to 48 to the ball's diameter, as many as are cheap.
// Those narrower than a cube may be missed; whether one is closed whose width differs by less than
// a step from the diameter is a matter of where the grid lies. The patch is made of faces of cubes,
// the smallest that part what is behind, at most two steps behind what the ball reaches. That they
// do is decided exactly.
struct SealOptions {
  double size = 0;        // diameter of the ball, in the soup's unit; 0: nothing is sealed
  bool is_share = false;  // it is a share of the diagonal of the solid's bounding box instead
  // The size is that of the narrowest neck that find_necks() finds; without one nothing is sealed.
  bool automatic = false;
  // Of the grid. More than an eighth only where openings need it; where even 6 to the diameter are
  // more, the size is refused with a UsageError.
  std::size_t most_cubes = std::size_t{1} << 23;

  [[nodiscard]] bool wanted() const { return automatic || size > 0; }
};

struct SealReport {
  bool automatic = false;    // the size was found, not given; 0 where there is none
  double size = 0;           // in the soup's unit
  double step = 0;           // of the grid, in the soup's unit
  std::size_t openings = 0;  // that were closed
  double patches_area = 0;   // over them, in the soup's unit, squared
  double filled_volume = 0;  // that is solid since, in the soup's unit, cubed
  // Spaces behind openings that stay open, as a way around leads into them that cubes do not show.
  std::size_t leaks = 0;
};

// An opening that leads into a space at least three times as wide.
struct Neck {
  double width = 0;   // of a ball that passes, in the soup's unit
  double error = 0;   // how much larger the largest one may be
  double volume = 0;  // of the space behind, and of those that only lead there, rounded to cubes
};

// Those of the boundary of a solid that hold at least `least_share` of its volume, the narrowest
// first. Found with grids of cubes, of at most `most_cubes` each: openings narrower than two steps
// of the finest are missed. Throws Cancelled.
[[nodiscard]] std::vector<Neck> find_necks(const TriangleSoup& solid, double least_share,
                                           std::size_t most_cubes = std::size_t{1} << 21,
                                           ProgressObserver* progress = nullptr);

// What find_necks() is asked for where a size to seal is wanted.
inline constexpr double kWorthSealing = 0.01;

// A size that surely closes the neck.
[[nodiscard]] inline double size_to_seal(const Neck& neck) {
  return 1.2 * (neck.width + neck.error);
}

}  // namespace meshrepair
