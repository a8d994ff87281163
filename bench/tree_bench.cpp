// SPDX-License-Identifier: MIT
// How long does building the tree take, and how large does it get?
#include <string>

#include <bsp/build_tree.h>
#include <bsp/clean_soup.h>

#include "bench_cases.h"

using namespace meshrepair;

int main(int argc, char** argv) {
  bench::run_cases<CleanSoup>(
      argc, argv, "build_tree",
      [](const TriangleSoup& soup) {
        CleanReport report;
        return clean_soup(soup, report);
      },
      [](CleanSoup& soup) {
        BuildTreeReport report;
        const Tree tree = build_tree(std::move(soup), {}, report);
        return std::to_string(report.nodes) + " nodes, depth " + std::to_string(report.depth);
      });
  return 0;
}
