// SPDX-License-Identifier: MIT
// Which cells are solid.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <repair/cell_graph.h>
#include <repair/orient_parts.h>
#include <repair/solidity.h>

namespace meshrepair {

enum class InsideRule {
  automatic,  // winding where the orientation can be trusted, else solidity: see label_cells()
  solidity,   // s > 0, then everything that a flood from infinity does not reach (WM 6.2)
  parity,     // s > 0 alone
  winding,    // w > 1/2, whatever the values
};

[[nodiscard]] std::string_view rule_name(InsideRule rule);

// What becomes of a void, a hollow space that no way leads into from outside.
enum class Cavities {
  keep,  // what the rule says
  fill,  // solid, with all that is in it
};

struct InsideOptions {
  InsideRule rule = InsideRule::automatic;
  Cavities cavities = Cavities::keep;
  SolveOptions solve;
  // `automatic` trusts the winding when its values are this near to integers (mean over the cells,
  // weighted by the area of their facets; values that mean nothing come to a quarter) ...
  double trusted_distance = 0.25;
  // ... and at most this share of the covered area is passed with another change than its triangles
  // say. Measured on 750 corrupted copies of 30 closed meshes, up to a tenth of the triangles
  // missing: where the winding is right, distances reach 0.17 and contradictions 0.03. Of triangles
  // without neighbours the share that is turned wrongly is the contradiction.
  double trusted_contradiction = 0.05;
  // Open sheets between two places alike are left out of that, up to this share of the covered
  // area.
  double trusted_loose_share = 0.25;
  // Parts are pieces of larger ones, each of which bounds solid with this area at least, in the
  // input's units, squared: folds are small beside that. Of label_cells() in square grid steps.
  double least_solid_area = 0;
};

struct InsideReport {
  InsideRule asked = InsideRule::automatic;
  InsideRule used = InsideRule::automatic;
  std::string reason;  // why `used`, for the user
  bool exact = false;  // the walk from infinity met no contradiction, nothing was solved
  std::size_t contradictions = 0;  // links at which it did
  SolveReport solve;               // all 0 when nothing was solved
  double winding_distance = 0;     // as in the options; only where a winding was looked at
  double winding_contradiction = 0;
  double loose_share = 0;
  // Of the parts of the surface; `automatic` only.
  std::size_t turned_parts = 0;    // inside out by their own triangles, and turned
  std::size_t doubtful_parts = 0;  // whose triangles do not tell which way is out ...
  std::size_t cavity_walls = 0;    // ... and that were found to be walls of cavities
  std::size_t poking_walls = 0;    // of cavities, that poke out of what is around them ...
  double poking_share = 0;         // ... and of one of them, at most, the share of its area
  // The rule that gives another solid, which is nearly as likely; `automatic`: there is none.
  InsideRule other = InsideRule::automatic;
  std::size_t left_out_folds = 0;  // that wind the wrong way: slivers, and what a patch cuts off
  std::size_t filled_voids = 0;    // made solid because of the rule or the option
  std::size_t solid_cells = 0;
};

struct CellLabels {
  std::vector<char> solid;        // of each cell
  std::vector<float> confidence;  // 0 to 1
};

// The windings of the graph's links are those of the soup for the rule `winding`, those of the
// orientation for `automatic`; the other rules look at none. Of the orientation, only `automatic`
// looks at more than which part a triangle belongs to.
//
// `automatic` first looks whether the winding numbers can be trusted, then turns parts that are
// inside out or do not tell which way is out: shells that lie in the solid of others, those that
// face inward with 66 % of their area at least, are walls of cavities, others face outward.
// Solid is what they wind around, and what winds the other way and borders the outside. Where the
// winding cannot be trusted, it is `solidity`, but voids are kept that are bounded by whole parts.
[[nodiscard]] CellLabels label_cells(const CellGraph& graph, const Orientation& orientation,
                                     const InsideOptions& options, InsideReport& report);

// In words, to go behind the reason for a rule: the parts that were turned; empty where none was.
[[nodiscard]] std::string what_was_turned(const InsideReport& report);

}  // namespace meshrepair
