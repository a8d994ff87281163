#include "large_openings.h"

#include <vector>

#include <gtest/gtest.h>

namespace meshrepair::internal {
namespace {

using Flags = std::vector<char>;

TEST(LargeOpenings, AHoleInAShellIsCompared) {
  EXPECT_EQ(find_large_openings(std::vector<Opening>{{0, 1}}, {5}, 0.2), Flags{0});
  EXPECT_EQ(find_large_openings(std::vector<Opening>{{0, 1}}, {5}, 0.19), Flags{1});
  EXPECT_EQ(find_large_openings({}, {5}, 0.2), Flags{});
}

TEST(LargeOpenings, PatchesCountAsSurfaceForEachOther) {
  // A tube much shorter than wide has two lids.
  EXPECT_EQ(find_large_openings(std::vector<Opening>{{0, 3}, {0, 3}}, {1}, 0.75), (Flags{0, 0}));
  EXPECT_EQ(find_large_openings(std::vector<Opening>{{0, 3}, {1, 3}}, {1, 1}, 0.75), (Flags{1, 1}));
}

TEST(LargeOpenings, WhatIsLeftOpenIsNoSurface) {
  // A flat sheet with holes in it: without its rim closed, only the small hole is small.
  const std::vector<Opening> openings = {{0, 0.5}, {0, 10}, {0, 6}};
  EXPECT_EQ(find_large_openings(openings, {3.5}, 0.95), (Flags{0, 1, 1}));
}

}  // namespace
}  // namespace meshrepair::internal
