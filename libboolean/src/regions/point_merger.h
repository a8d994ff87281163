// SPDX-License-Identifier: MIT
// Bodies whose faces nearly coincide leave slivers between them that are thinner than numbers can
// say. A point moves onto one nearby, whether an edge joins the two or not; an edge is led over a
// point, or two over a new one; or an edge is turned. As a map of chains that keeps the boundary of
// each region closed: a triangle with two equal corners is nothing, and equal triangles add up. So
// a chamber that is flat is no more, and what is on both its sides is next to each other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <base/progress.h>
#include <mesh/precision.h>

#include "region_complex.h"

namespace meshrepair::internal {

struct MergeOptions {
  double within = 0;                         // how far a point or an edge may move
  Precision precision = Precision::float64;  // of new points
  ProgressObserver* progress = nullptr;      // not owned
};

// Makes edits around pairs of triangles that are at fault: they meet, or one has no area, or is at
// an edge that is turned (region_edges.h). These are a triangle twice.
class PointMerger {
 public:
  using Pairs = std::vector<std::array<std::uint32_t, 2>>;

  // `complex` keeps its place, and is as it was until finish() is called.
  PointMerger(RegionComplex& complex, const Pairs& pairs, const MergeOptions& options);
  ~PointMerger();

  // Makes the edit around the two triangles that leaves the fewest faults, if it leaves fewer.
  bool improve(std::uint32_t t, std::uint32_t u);

  // The most that an edge or a point moved.
  [[nodiscard]] double distance() const;

  // Puts the result into the complex.
  void finish();

 private:
  class Search;
  std::unique_ptr<Search> search_;
};

}  // namespace meshrepair::internal
