// SPDX-License-Identifier: MIT
// Where cavities drain, and what is drilled for that.
#pragma once

#include <cstdint>
#include <optional>
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

// The walls of one cavity, and its deepest place.
struct CavityPlaces {
  std::vector<Place> corners;      // of the walls: among them drains are looked for
  std::vector<Corners> triangles;  // the walls
  Place deepest;
};

class DrainPlacer {
 public:
  // `solid` is what Depth was made of. All have to stay.
  DrainPlacer(const TriangleSoup& solid, const Depth& depth, const HollowOptions& options);

  // One from the place of the surface that is nearest to the point, into this cavity; nothing where
  // none fits.
  [[nodiscard]] std::optional<Drill> from_point(const Vec3d& point,
                                                const CavityPlaces& cavity) const;
  // The distance of a cavity from the place of the surface that is nearest to the point.
  [[nodiscard]] double distance(const Vec3d& point, const CavityPlaces& cavity) const;

  // The lowest one that fits, and the one farthest from it.
  [[nodiscard]] std::vector<Drill> for_cavity(const CavityPlaces& cavity) const;

  // Closed, turned outward.
  [[nodiscard]] TriangleSoup prism(const Drill& drill) const;

 private:
  [[nodiscard]] std::optional<Drill> through(const Place& wall) const;
  [[nodiscard]] std::optional<Drill> drill(const Vec3d& mouth, const Vec3d& inward,
                                           const Vec3d& end, std::uint32_t nearest) const;
  [[nodiscard]] bool is_on_outside(std::uint32_t nearest) const;

  const Depth& depth_;
  const HollowOptions& options_;
  std::vector<char> outside_;  // of each triangle of the solid: it is no wall of a void
};

}  // namespace meshrepair::internal
