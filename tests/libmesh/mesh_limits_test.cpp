// SPDX-License-Identifier: MIT
// What is larger than its numbers tell is refused before it is touched.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>
#include <base/ids.h>
#include <mesh/edge_table.h>
#include <mesh/mesh_limits.h>

namespace meshrepair {
namespace {

template <class Call>
std::string refusal_of(Call call) {
  try {
    call();
  } catch (const LimitError& error) {
    return error.what();
  }
  return "";
}

TEST(MeshLimits, EachSideHasANumberThatIsNotNone) {
  EXPECT_LT(3 * std::uint64_t{kMostTriangles} - 1, kNone);
  EXPECT_GE(3 * (std::uint64_t{kMostTriangles} + 1) - 1, kNone);
}

TEST(MeshLimits, TheMostIsNotRefused) {
  EXPECT_NO_THROW(require_points(kMostPoints, "a"));
  EXPECT_NO_THROW(require_triangles(kMostTriangles, "a"));
}

TEST(MeshLimits, MoreIsRefusedInOneLine) {
  const std::uint64_t one = 1;
  EXPECT_EQ(refusal_of([&] { require_points(kMostPoints + one, "a.stl"); }),
            "a.stl: more than 4294967294 points");
  EXPECT_EQ(refusal_of([&] { require_triangles(kMostTriangles + one, "a.stl"); }),
            "a.stl: more than 1431655765 triangles");
  EXPECT_EQ(refusal_of([&] { require_triangles(kMostTriangles + one); }),
            "more than 1431655765 triangles");
}

// No such list is there: it is refused by its size alone.
TEST(MeshLimits, HoldForTheSidesOfATable) {
  const std::vector<IndexTriangle> triangles(1);
  const std::span<const IndexTriangle> list(triangles.data(), kMostTriangles + 1);
  EXPECT_EQ(refusal_of([&] { (void)EdgeTable(list); }), "more than 1431655765 triangles");
}

}  // namespace
}  // namespace meshrepair
