// Which cells are solid.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <repair/cell_graph.h>
#include <repair/solidity.h>

namespace meshrepair {

enum class InsideRule {
  automatic,  // winding where the orientation can be trusted, else solidity
  solidity,   // s > 0, then everything that a flood from infinity does not reach (WM 6.2)
  parity,     // s > 0 alone
  winding,    // w > 1/2, whatever the values
};

[[nodiscard]] std::string_view rule_name(InsideRule rule);

struct InsideOptions {
  InsideRule rule = InsideRule::automatic;
  SolveOptions solve;
  // `automatic` trusts the winding when its values are this near to integers (mean over the cells,
  // weighted by the area of their facets) ...
  double trusted_distance = 0.1;
  // ... and at most this share of the covered area is passed with another change than its triangles
  // say.
  double trusted_contradiction = 0.05;
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
  std::size_t solid_cells = 0;
};

struct CellLabels {
  std::vector<char> solid;        // of each cell
  std::vector<float> confidence;  // 0 to 1
};

[[nodiscard]] CellLabels label_cells(const CellGraph& graph, const InsideOptions& options,
                                     InsideReport& report);

}  // namespace meshrepair
