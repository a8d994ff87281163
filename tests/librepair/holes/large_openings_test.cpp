// SPDX-License-Identifier: MIT
#include <vector>

#include <gtest/gtest.h>

#include "holes/sheet_rims.h"

namespace meshrepair::internal {
namespace {

using Flags = std::vector<char>;

TEST(LargeOpenings, AHoleInAShellIsCompared) {
  EXPECT_EQ(find_large_openings(std::vector<Opening>{{0, 1, 0.2}}, {5}), Flags{0});
  EXPECT_EQ(find_large_openings(std::vector<Opening>{{0, 1, 0.19}}, {5}), Flags{1});
  EXPECT_EQ(find_large_openings({}, {5}), Flags{});
}

TEST(LargeOpenings, PatchesCountAsSurfaceForEachOther) {
  // A tube much shorter than wide has two lids.
  EXPECT_EQ(find_large_openings(std::vector<Opening>{{0, 3, 0.75}, {0, 3, 0.75}}, {1}),
            (Flags{0, 0}));
  EXPECT_EQ(find_large_openings(std::vector<Opening>{{0, 3, 0.75}, {1, 3, 0.75}}, {1, 1}),
            (Flags{1, 1}));
}

TEST(LargeOpenings, OpenHolesAddNoSurface) {
  // A flat sheet with holes in it: without its rim closed, only the small hole is small.
  const std::vector<Opening> openings = {{0, 0.5, 0.95}, {0, 10, 0.95}, {0, 6, 0.95}};
  EXPECT_EQ(find_large_openings(openings, {3.5}), (Flags{0, 1, 1}));
}

}  // namespace
}  // namespace meshrepair::internal
