// SPDX-License-Identifier: MIT
// Writes degenerate random soups as OFF files: those that the property tests are made of.
//
// Usage: write_soups COUNT FOLDER
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>

#include <base/error.h>
#include <mesh/soup_io.h>

#include "degenerate_soups.h"

int main(int count, char** arguments) try {
  using namespace meshrepair;
  if (count != 3) {
    std::cerr << "write_soups COUNT FOLDER\n";
    return EXIT_FAILURE;
  }
  const std::filesystem::path folder = arguments[2];
  const std::uint64_t soups = std::stoull(arguments[1]);
  const auto& families = testing::degenerate_families();
  for (std::uint64_t seed = 0; seed < soups; ++seed) {
    const testing::SoupFamily& family = families[seed % families.size()];
    const std::string name = std::to_string(seed) + "_" + family.name + ".off";
    write_soup(family.make(seed), folder / name);
  }
  return EXIT_SUCCESS;
} catch (const std::exception& error) {
  std::cerr << "write_soups: " << error.what() << '\n';
  return EXIT_FAILURE;
}
