// SPDX-License-Identifier: MIT
// strands_held ship|harp MESH: how many of the model's thin parts are in the solid that the mesh
// bounds. Prints the number.
#include <cstdio>
#include <string>

#include <mesh/soup_io.h>

#include "models.h"

int main(int argc, char** argv) {
  using namespace meshrepair;
  if (argc != 3) {
    std::fprintf(stderr, "Usage: strands_held ship|harp MESH\n");
    return 2;
  }
  const bench::Model model = std::string(argv[1]) == "ship" ? bench::ship() : bench::harp();
  std::printf("%zu\n", bench::strands_held(read_soup(argv[2]).soup, model));
  return 0;
}
