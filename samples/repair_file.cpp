// SPDX-License-Identifier: MIT
// Repairs a mesh file: the shortest useful program.
//
//   repair_file IN OUT
//
// One idea: read, repair, write; everything that can go wrong is an exception with one line to
// print.
#include <cstdio>
#include <exception>

#include <mesh/soup_io.h>
#include <repair/repair.h>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: repair_file IN OUT\n", stderr);
    return 2;
  }
  try {
    const meshrepair::ReadResult input = meshrepair::read_soup(argv[1]);
    const meshrepair::RepairResult result = meshrepair::repair(input.soup);
    meshrepair::write_soup(result.surface.mesh, argv[2]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "repair_file: %s\n", error.what());
    return 1;
  }
}
