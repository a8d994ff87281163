// SPDX-License-Identifier: MIT
// What does each inside rule make of damaged input? Volumes, next to the truth where it is known.
// Any mesh files given are flipped at random and added as rows.
#include <cstdio>
#include <string>
#include <vector>

#include <base/error.h>
#include <mesh/soup_io.h>
#include <repair/repair.h>

#include "shapes.h"

using namespace meshrepair;
using namespace meshrepair::testing;

namespace {

double volume_by(const TriangleSoup& soup, InsideRule rule) {
  RepairOptions options;
  options.inside.rule = rule;
  try {
    return repair(soup, options).report.output_volume;
  } catch (const NoSolidError&) {
    return 0;
  }
}

void print_row(const std::string& name, const TriangleSoup& soup, const std::string& truth) {
  std::printf("| %-42s | %9s |", name.c_str(), truth.c_str());
  for (const InsideRule rule :
       {InsideRule::parity, InsideRule::solidity, InsideRule::winding, InsideRule::automatic}) {
    std::printf(" %9.4f |", volume_by(soup, rule));
    std::fflush(stdout);
  }
  std::printf("\n");
}

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4f", x);
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  const TriangleSoup spheres = two_overlapping_spheres(20000);
  const TriangleSoup cubes = random_cubes(100, 1);
  TriangleSoup hollow = sphere(10000, 1);
  append(hollow, flipped(sphere(5000, 0.6)));
  const double united_spheres = volume_by(spheres, InsideRule::winding);
  const double united_cubes = volume_by(cubes, InsideRule::winding);
  const double shell = signed_volume(hollow);

  std::printf(
      "| case | truth | s > 0 | s, then flood | w > 1/2 | auto |\n|---|---|---|---|---|---|\n");
  print_row("two overlapping spheres", spheres, number(united_spheres));
  print_row("the same, 5 % of triangles missing", without_some(spheres, 0.05, 1),
            number(united_spheres));
  print_row("100 cubes", cubes, number(united_cubes));
  print_row("the same, 5 % missing", without_some(cubes, 0.05, 1), number(united_cubes));
  print_row("hollow sphere", hollow, number(shell));
  for (int i = 1; i < argc; ++i) {
    const TriangleSoup soup = read_soup(argv[i]).soup;
    for (const double share : {0.0, 0.2, 0.4, 0.5}) {
      print_row(std::string(argv[i]) + ", " + std::to_string(static_cast<int>(100 * share)) +
                    " % flipped",
                with_some_flipped(soup, share, 1), "");
    }
  }
  return 0;
}
