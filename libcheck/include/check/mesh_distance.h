// SPDX-License-Identifier: MIT
// How far are two meshes apart, as surfaces?
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <base/progress.h>
#include <mesh/soup.h>

namespace meshrepair {

struct DistanceOptions {
  std::size_t samples = 200000;  // each way, evenly by area
  std::uint64_t seed = 1;        // the same seed gives the same samples
  bool bound = false;            // also fill OneSidedDistance::bound
  double bound_factor = 1.1;     // the bound aims at this times the largest distance found; above 1
  std::size_t most_pieces = 4'000'000;   // that are looked at for the bound, each way
  ProgressObserver* progress = nullptr;  // not owned; stages "sample" and "bound", each way
  // For one_sided_distance(): of each triangle of the one mesh which of the other one has the same
  // corners, if any does; all ones: none. Empty: they are looked for.
  std::span<const std::uint32_t> twins = {};
};

// From each point of one mesh to the nearest point of the other.
struct OneSidedDistance {
  std::size_t samples = 0;  // 0 where the mesh has no area
  double mean = 0;
  double rms = 0;
  double largest = 0;        // over the samples and all corners: the Hausdorff distance from below
  Vec3d at = Vec3d::Zero();  // where that is
  // Not exceeded anywhere, rounding included.
  std::optional<double> bound;
};

struct MeshDistance {
  OneSidedDistance forth;  // from the first to the second
  OneSidedDistance back;
  double diagonal = 0;         // of the first mesh's bounding box
  std::size_t not_finite = 0;  // triangles of both that were left out

  // The two-sided Hausdorff distance, from below and from above.
  [[nodiscard]] double largest() const;
  [[nodiscard]] std::optional<double> bound() const;
};

// In the unit of the coordinates: all of them times a power of two gives the same results times
// that. What is beyond doubles is infinite. The same for any number of threads. Throws InputError
// where a mesh has no triangle that is finite, UsageError where the options make no sense,
// Cancelled.
[[nodiscard]] MeshDistance mesh_distance(const TriangleSoup& first, const TriangleSoup& second,
                                         const DistanceOptions& options = {});

// The one way alone: from the points of one mesh to the other. As above; `bound` too.
[[nodiscard]] OneSidedDistance one_sided_distance(const TriangleSoup& from, const TriangleSoup& to,
                                                  const DistanceOptions& options = {});

// Triangles of `from`, in their order, some point of which may be farther than that from `to`; all
// others are proven to be within, rounding included. Cheaper than a bound. All corners are finite.
// The same for any number of threads. Throws as above.
[[nodiscard]] std::vector<std::uint32_t> triangles_beyond(const TriangleSoup& from,
                                                          const TriangleSoup& to, double distance,
                                                          ProgressObserver* progress = nullptr);

// Of the box around the triangles that are finite. Throws InputError where there is none.
[[nodiscard]] double bounding_diagonal(const TriangleSoup& soup);

}  // namespace meshrepair
