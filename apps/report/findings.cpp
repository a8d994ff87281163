// SPDX-License-Identifier: MIT
#include "report/findings.h"

#include <filesystem>

namespace meshrepair {

std::string Findings::input_name() const { return input == "-" ? "standard input" : input; }

std::string Findings::output_name() const { return output == "-" ? "standard output" : output; }

std::string Findings::written_name() const {
  if (staging.empty()) return output_name();
  const std::filesystem::path name = std::filesystem::path(output).filename();
  return (std::filesystem::path(staging) / name).string() + ", to be " + output;
}

TreeFacts facts_of(const Tree& tree) {
  TreeFacts facts;
  facts.triangles = tree.input.triangles.size();
  facts.nodes = tree.nodes.size();
  facts.leaves = tree.leaves.size();
  std::size_t unknown = 0;
  for (const Leaf& leaf : tree.leaves) {
    facts.solid_leaves += leaf.label == Label::solid;
    unknown += leaf.label == Label::unknown;
  }
  facts.labelled = unknown == 0;
  return facts;
}

}  // namespace meshrepair
