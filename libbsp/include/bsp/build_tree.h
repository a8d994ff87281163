// SPDX-License-Identifier: MIT
// From a clean soup to its tree (Thibault and Naylor 1987, with spatial cuts near the root).
#pragma once

#include <cstddef>

#include <base/progress.h>
#include <bsp/clean_soup.h>
#include <bsp/tree.h>

namespace meshrepair {

struct BuildTreeOptions {
  // Regions with more fragments than this are first tried with an axis-parallel cut.
  std::size_t spatial_cut_above = 64;
  // A spatial cut is refused when both sides together hold more than this share of the fragments
  // ...
  double largest_total_share = 1.6;
  // ... or one side more than this.
  double largest_side_share = 0.95;
  // A spatial cut through more than this share of the fragments has to be better than the best
  // plane through an edge.
  double tolerated_cut_share = 0.3;
  // How many fragments offer their plane, and on how many fragments each offer is judged.
  std::size_t candidates = 6;
  std::size_t judged_fragments = 128;
  // An offer's cost is split_weight * (fragments cut) + |front - back|.
  std::size_t split_weight = 8;
  ProgressObserver* progress = nullptr;
};

struct BuildTreeReport {
  std::size_t nodes = 0;
  std::size_t leaves = 0;
  std::size_t depth = 0;
  std::size_t spatial_cuts = 0;    // nodes with an axis-parallel plane of our own
  std::size_t edge_cuts = 0;       // nodes with a plane through an edge, across its triangle
  std::size_t fragments = 0;       // at the nodes, in the end
  std::size_t lost_fragments = 0;  // that fell on no side of a plane; 0 with exact predicates
};

// Every triangle ends, in fragments, at nodes with its plane. The same soup gives the same tree;
// the orientation of its triangles does not matter. Takes over the soup.
[[nodiscard]] Tree build_tree(CleanSoup soup, const BuildTreeOptions& options,
                              BuildTreeReport& report);

}  // namespace meshrepair
