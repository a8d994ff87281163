// SPDX-License-Identifier: MIT
// Models made by code, of the kinds and sizes that Wang and Manocha's tables name: where theirs are
// scans and drawings, these are as much like them as a few lines allow.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <mesh/soup.h>

namespace meshrepair::bench {

// A thin part, and the middle line along which it has to be found in a result.
struct Strand {
  std::vector<Vec3d> line;
  double radius = 0;
};

struct Model {
  std::string name;
  std::string paper_name;  // of its counterpart there
  TriangleSoup soup;
  std::vector<Strand> strands;
};

// Waves of several lengths on a star-shaped body around the origin: nothing crosses.
[[nodiscard]] TriangleSoup bumpy(TriangleSoup soup, double height, std::uint64_t seed);

// Parts that cross one another, each closed.
[[nodiscard]] Model spider();
[[nodiscard]] Model turtle();
[[nodiscard]] Model cow();
[[nodiscard]] Model head();
[[nodiscard]] Model oil_rig();
[[nodiscard]] Model ship();  // its strands are the ropes
[[nodiscard]] Model harp();  // its strands are the strings

// Closed, and nothing crosses.
[[nodiscard]] Model blob();   // in place of a scanned animal
[[nodiscard]] Model bone();   // 5,000 triangles
[[nodiscard]] Model truss();  // 39,744, to be met with the bone
[[nodiscard]] Model pig();    // 1,296
[[nodiscard]] Model helix();  // 74,000, to be taken from the pig

// The seven that cross themselves, in the order of the paper's table 4.
[[nodiscard]] std::vector<Model> crossing_models();

// Whether the middle line, but for a tenth at each end, is inside the solid that the mesh bounds:
// by the solid angle of the mesh, so the mesh need not be perfect.
[[nodiscard]] bool holds_strand(const TriangleSoup& solid, const Strand& strand);
[[nodiscard]] std::size_t strands_held(const TriangleSoup& solid, const Model& model);

// The points of the line at which it is looked for.
[[nodiscard]] std::vector<Vec3d> probes_of(const Strand& strand);

}  // namespace meshrepair::bench
