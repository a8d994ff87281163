// SPDX-License-Identifier: MIT
// Beam lattices of 3MF, as its elements say them, and the closed bodies that they stand for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <mesh/soup.h>

#include "common/xml_stream.h"

namespace meshrepair {

enum class BeamCap : std::uint8_t { sphere, hemisphere, butt };

// A round bar between two points of the mesh, whose radius changes evenly from one to the other.
struct Beam {
  std::uint32_t points[2];  // numbers of the file: they may be of none
  double radii[2];
  BeamCap caps[2];
};

struct BeamBall {
  std::uint32_t point = 0;
  double radius = 0;
};

struct BeamLattice {
  double shortest = 0;  // shorter beams are none
  double radius = 0;    // where a beam says none
  double ball_radius = 0;
  BeamCap cap = BeamCap::sphere;
  bool has_balls = false;            // else those that are listed are none
  bool has_ball_everywhere = false;  // where a beam ends
  bool is_clipped = false;           // by a mesh
  std::vector<Beam> beams;
  std::vector<BeamBall> balls;
};

// Without its beams and balls.
[[nodiscard]] BeamLattice read_lattice(const XmlAttributes& attributes);

// What they do not say is as in the lattice.
[[nodiscard]] Beam read_beam(const XmlAttributes& attributes, const BeamLattice& lattice);
[[nodiscard]] BeamBall read_ball(const XmlAttributes& attributes, const BeamLattice& lattice);

// How many triangles they become at most.
[[nodiscard]] std::size_t most_triangles_of(const BeamLattice& lattice, std::size_t sides);

// Appends a closed body for each beam and each ball, which overlap each other. Circles become
// polygons of `sides` corners, which lie on them. Beams and balls of points that are not there, or
// without a finite size, are left out; their number is returned.
std::size_t append_lattice(const BeamLattice& lattice, std::size_t sides, TriangleSoup& mesh);

}  // namespace meshrepair
