// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <mesh/coloured_ply.h>

#include "soup_fixtures.h"

namespace meshrepair {
namespace {

TEST(ColouredPly, IsReadBackAsTheMesh) {
  const TriangleSoup soup = tetrahedron();
  const std::vector<Colour> colours = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {250, 251, 252}};
  const std::string bytes = format_coloured_ply(soup, colours, {"a legend"});
  EXPECT_NE(bytes.find("\ncomment a legend\n"), std::string::npos);
  EXPECT_EQ(bytes.substr(bytes.size() - 3), "\xFA\xFB\xFC");
  const ReadResult back = read_text(bytes, "marked.ply");
  EXPECT_EQ(point_bits(back.soup), point_bits(soup));
  EXPECT_EQ(back.soup.triangles, soup.triangles);
  EXPECT_TRUE(back.report.warnings.empty());
}

}  // namespace
}  // namespace meshrepair
