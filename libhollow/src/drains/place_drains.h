// SPDX-License-Identifier: MIT
// Where cavities drain, and what is drilled for that.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <hollow/hollow_options.h>
#include <hollow/hollow_report.h>
#include <mesh/soup.h>

#include "common/depth.h"

namespace meshrepair::internal {

// A cylinder, or what comes near: a prism that holds it.
struct Drill {
  Drain drain;
  Vec3d from = Vec3d::Zero(), to = Vec3d::Zero();  // the middles of its ends, outside and within
};

// Closed, turned outward.
[[nodiscard]] TriangleSoup prism_of(const Drill& drill, double diameter);

// The walls of one cavity, and its deepest place.
struct CavityPlaces {
  std::vector<Place> corners;      // of the walls: among them drains are looked for
  std::vector<Corners> triangles;  // the walls, closed, turned out of the cavity
  Place deepest;
};

// Drains keep the wall from all of the surface but that around their mouths, and from each other,
// where such places exist; else they leave as much as can be. Where that is almost nothing, there
// is no drain.
class DrainPlacer {
 public:
  // `solid` is what Depth was made of. All have to stay.
  DrainPlacer(const TriangleSoup& solid, const Depth& depth, const HollowOptions& options);

  // One from the place of the surface that is nearest to the point, into this cavity; nothing where
  // none fits. `others` are drilled, too; where it overlaps one, Drain::beside is not above 0.
  [[nodiscard]] std::optional<Drill> from_point(const Vec3d& point, const CavityPlaces& cavity,
                                                std::span<const Drill> others) const;
  // The distance of a cavity from the place of the surface that is nearest to the point.
  [[nodiscard]] double distance(const Vec3d& point, const CavityPlaces& cavity) const;

  // The lowest one that fits, and the one farthest from it.
  [[nodiscard]] std::vector<Drill> for_cavity(const CavityPlaces& cavity,
                                              std::span<const Drill> others) const;

  // The least distance between two; not above 0 where they overlap.
  [[nodiscard]] double between(const Drill& a, const Drill& b) const;

 private:
  class Search;
  [[nodiscard]] bool is_on_outside(std::uint32_t nearest) const;

  const Depth& depth_;
  const HollowOptions& options_;
  std::vector<char> outside_;  // of each triangle of the solid: it is no wall of a void
};

}  // namespace meshrepair::internal
