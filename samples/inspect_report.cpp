// SPDX-License-Identifier: MIT
// Says what is wrong with a mesh and which of its triangles the repair kept.
//
//   inspect_report IN
//
// One idea: the report tells what was found and why it was decided as it was, and each triangle of
// the result knows the triangle of the input that it lies in.
#include <cstdint>
#include <cstdio>
#include <exception>
#include <set>

#include <base/error.h>
#include <mesh/soup_io.h>
#include <repair/repair.h>

namespace {

using namespace meshrepair;

void print_defects(const RepairReport& report) {
  std::printf("open edges:            %zu\n", report.input.open_edges);
  std::printf("non-manifold edges:    %zu\n", report.input.nonmanifold_edges);
  std::printf("inconsistent edges:    %zu\n", report.input.inconsistent_edges);
  std::printf("duplicate triangles:   %zu\n",
              report.clean.duplicates + report.clean.opposite_duplicates);
  std::printf("triangles turned:      %zu\n", report.orient.turned_triangles);
}

void print_decision(const InsideReport& inside) {
  std::printf("decided by:            %s (%s)\n", rule_name(inside.used).data(),
              inside.reason.c_str());
}

void print_use(const TriangleSoup& input, const Surface& surface) {
  std::set<std::uint32_t> used;
  std::size_t closing = 0;
  for (const std::uint32_t source : surface.source) {
    if (source == Surface::kNoSource) {
      ++closing;
    } else {
      used.insert(source);
    }
  }
  std::printf("input triangles used:  %zu of %zu\n", used.size(), input.triangles.size());
  std::printf("triangles over gaps:   %zu of %zu\n", closing, surface.source.size());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: inspect_report IN\n", stderr);
    return 2;
  }
  try {
    const ReadResult input = read_soup(argv[1]);
    RepairReport report;  // given separately it is there even if nothing is enclosed
    try {
      const Surface surface = repair(input.soup, {}, report);
      print_defects(report);
      print_decision(report.inside);
      print_use(input.soup, surface);
    } catch (const NoSolidError& error) {
      print_defects(report);
      std::printf("no solid:              %s\n", error.what());
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "inspect_report: %s\n", error.what());
    return 1;
  }
}
