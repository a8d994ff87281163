// SPDX-License-Identifier: MIT
// One labelled tree from two (Naylor, Amanatides and Thibault 1990; Lysenko, D'Souza and Shene
// 2008).
#pragma once

#include <cstddef>
#include <cstdint>

#include <base/progress.h>
#include <boolean/set_operation.h>
#include <bsp/tree.h>

namespace meshrepair {

// How it is found out whether a plane cuts a region.
enum class RegionTest {
  cells,            // the region's polyhedron is carried along and cut
  linear_programs,  // the planes around the region are asked whether they have a volume in common
};

struct MergeOptions {
  RegionTest test = RegionTest::cells;
  // Both trees' labels differ only across their triangles, as those of closed surfaces do: then a
  // region that no triangle of the second reaches has one label there, and is not cut.
  bool sealed = false;
  // Added to the sources of the second tree's triangles.
  std::uint32_t second_source = 0;
  ProgressObserver* progress = nullptr;
};

struct MergeReport {
  std::size_t nodes = 0;        // before equal children were collapsed ...
  std::size_t kept_nodes = 0;   // ... and after
  std::size_t regions = 0;      // that were asked which side of a plane they are on
  std::size_t cut_regions = 0;  // that it cuts
};

// The second tree is put into the leaves of the first that do not decide the result; what is not in
// the region of such a leaf is left out. Both are labelled and on one grid; otherwise throws
// InputError. The result may be a single leaf.
[[nodiscard]] Tree merge_trees(const Tree& first, const Tree& second, SetOperation operation,
                               const MergeOptions& options, MergeReport& report);

}  // namespace meshrepair
