// SPDX-License-Identifier: MIT
// Mesh files as they occur in the wild, made by a program of their own. The environment variable
// MESHREPAIR_ODD_INPUTS names the folder that holds them and expect.json, whose entries read
//   "NAME": {"t": TRIANGLES, "v": POINTS or null, "note": "..."}
// each value on a line of its own. 0 triangles stands for a refusal.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/soup_io.h>

#include "soup_fixtures.h"

namespace meshrepair {
namespace {

struct Expected {
  std::string name;
  std::size_t triangles = 0;
  std::optional<std::size_t> points;
};

// Files about which expect.json is wrong, or from which a part can be read with the loss counted.
const std::map<std::string, std::size_t> kTrianglesFound = {
    {"asc_cut.stl", 1000},      // the cut falls just behind the facet number 1000
    {"oob.off", 2000},          // the index was put into a point, (13, 99999, 0), and is none
    {"nface.off", 1999},        // one face claims 2e9 corners: that line is left out
    {"asc_listlie.ply", 1999},  // the same
    {"cut.ply", 1412},          // cut behind so many faces
};

std::vector<Expected> read_expectations(const std::filesystem::path& path) {
  std::vector<Expected> expectations;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const std::string value = line.substr(line.find(": ") + 1);
    if (line.ends_with('{') && line.size() > 4) {
      expectations.push_back({line.substr(1, line.find('"', 1) - 1), 0, std::nullopt});
    } else if (line.starts_with("\"t\"")) {
      expectations.back().triangles = std::stoul(value);
    } else if (line.starts_with("\"v\"") && value.find("null") == std::string::npos) {
      expectations.back().points = std::stoul(value);
    }
  }
  return expectations;
}

TEST(OddInputs, AllAreReadOrRefusedAsTheyShould) {
  const char* const folder = std::getenv("MESHREPAIR_ODD_INPUTS");
  if (folder == nullptr)
    GTEST_SKIP() << "set MESHREPAIR_ODD_INPUTS to the folder that make.py has filled";
  const std::vector<Expected> expectations =
      read_expectations(std::filesystem::path(folder) / "expect.json");
  ASSERT_GT(expectations.size(), 90u);
  for (const Expected& expected : expectations) {
    SCOPED_TRACE(expected.name);
    const auto exception = kTrianglesFound.find(expected.name);
    const std::size_t triangles =
        exception == kTrianglesFound.end() ? expected.triangles : exception->second;
    try {
      const ReadResult result = read_soup(std::filesystem::path(folder) / expected.name);
      EXPECT_EQ(result.soup.triangles.size(), triangles);
      EXPECT_EQ(result.soup.points.size(), expected.points.value_or(result.soup.points.size()));
      expect_valid_indices(result.soup);
    } catch (const InputError& error) {
      EXPECT_EQ(triangles, 0u) << error.what();
    }
  }
}

}  // namespace
}  // namespace meshrepair
