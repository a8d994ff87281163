// A triangulation of a closed loop in space with little area and few folds.
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

}  // namespace meshrepair::internal
