// SPDX-License-Identifier: MIT
// Triangulations with little area and few folds: of a closed loop in space, and of the ring between
// two.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "rim.h"

namespace meshrepair::internal {

struct LoopTriangulation {
  // Positions in the loop, ascending: all triangles have the direction of the loop.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  double area = 0;
};

struct LoopTriangulationOptions {
  // Loops of up to so many edges get the optimum, which takes the cube of it; larger ones are first
  // cut along short chords.
  std::size_t most_edges = 200;
  std::function<void()> poll;  // may throw; unless empty
};

// A triangle that turns back onto the surface counts double.
//
// Liepa, "Filling holes in meshes" (2003), with one sum of areas, those of folded triangles
// weighted, instead of the largest angle first and then the area.
[[nodiscard]] LoopTriangulation triangulate_loop(const Rim& rim,
                                                 const LoopTriangulationOptions& options);

// No surface with this border has less area; one in a plane may have it.
[[nodiscard]] double least_area(const Rim& rim);

struct StripTriangulation {
  // Positions in `a`, and behind them those in `b`. Triangles with an edge of `a` have its
  // direction, and the others the one that agrees.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  double area = 0;
  bool folded =
      false;  // lies back on the surface at most of the edges: it is no gap that it closes
};

// The ring of least area that has an edge where the two loops come nearest to each other (Fuchs,
// Kedem and Uselton 1977), whatever their directions. Takes the product of their lengths.
[[nodiscard]] StripTriangulation triangulate_strip(const Rim& a, const Rim& b);

}  // namespace meshrepair::internal
