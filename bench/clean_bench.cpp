// SPDX-License-Identifier: MIT
// How long does bringing a soup onto the grid take?
#include <string>

#include <bsp/clean_soup.h>

#include "bench_cases.h"

using namespace meshrepair;

int main(int argc, char** argv) {
  bench::run_cases<const TriangleSoup*>(
      argc, argv, "clean_soup", [](const TriangleSoup& soup) { return &soup; },
      [](const TriangleSoup*& soup) {
        CleanReport report;
        const CleanSoup clean = clean_soup(*soup, report);
        return std::to_string(clean.planes.size()) + " planes";
      });
  return 0;
}
