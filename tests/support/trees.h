// SPDX-License-Identifier: MIT
// Soups brought to trees, for tests.
#pragma once

#include <utility>

#include <bsp/build_tree.h>
#include <bsp/clean_soup.h>
#include <bsp/tree.h>

namespace meshrepair::testing {

inline CleanSoup cleaned(const TriangleSoup& soup) {
  CleanReport report;
  return clean_soup(soup, report);
}

inline Tree tree_of(const TriangleSoup& soup, BuildTreeReport& report,
                    const BuildTreeOptions& options = {}) {
  return build_tree(cleaned(soup), options, report);
}

inline Tree tree_of(const TriangleSoup& soup) {
  BuildTreeReport report;
  return tree_of(soup, report);
}

}  // namespace meshrepair::testing
