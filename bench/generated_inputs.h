// SPDX-License-Identifier: MIT
// Inputs made by code, each from a seed, so that they are the same everywhere. Whatever their size,
// each triangle has about as many neighbours and crosses about as many others: what grows faster
// than the input is the program's own doing.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <mesh/soup.h>

namespace meshrepair::bench {

// The mesh of a name "KIND:N", of about N triangles but for cubes. Throws UsageError if there is no
// such kind, or N is no number above 0.
//
//   clean    a sphere
//   holes    a sphere without one in a hundred of its triangles
//   bumpy    two bumpy spheres that overlap
//   noisy    a sphere whose points are moved by up to an edge, so that neighbours cross
//   cubes    N turned cubes, of 12 triangles each; each overlaps a few others
//   soup     a sphere whose triangles share no points, their corners moved by a millionth
//   spheres  two spheres that overlap, with poles
[[nodiscard]] TriangleSoup generated_mesh(const std::string& name);

// Whether it begins with one of these kinds and a colon.
[[nodiscard]] bool is_generated_mesh(const std::string& name);

// Writes a generated input as KIND_N.off; also "union:N", the two bodies of bumpy in files of their
// own, union_N_a.off and union_N_b.off, and "cloud:N", N random points on a torus, as cloud_N.xyz.
// Returns the files. Throws as generated_mesh(), and OutputError.
std::vector<std::filesystem::path> write_generated(const std::string& name,
                                                   const std::filesystem::path& folder);

}  // namespace meshrepair::bench
