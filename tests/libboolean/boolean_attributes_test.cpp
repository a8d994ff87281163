// SPDX-License-Identifier: MIT
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <boolean/boolean.h>
#include <repair/transfer_attributes.h>

#include "shapes.h"
#include "textured.h"
#include "textured_surface.h"

namespace meshrepair {
namespace {

using namespace testing;

std::vector<TriangleSoup> three_balls() {
  return {sphere(800), sphere(600, 0.8, {0.7, 0.3, 0.1}), sphere(500, 0.6, {-0.4, 0.5, -0.6})};
}

TexturedSurface combined(const TexturedSoup& input, SetOperation operation, bool by_trees) {
  BooleanOptions options;
  options.by_trees = by_trees;
  keep_attributes(input.soup, input.attributes, options.repair);
  BooleanReport report;
  TexturedSurface result;
  result.surface = boolean(three_balls(), operation, options, report);
  EXPECT_TRUE(report.result.certify.passed());
  result.attributes = transfer_attributes(input.soup, input.attributes, result.surface);
  return result;
}

TEST(BooleanAttributes, AttributesComeFromTheOperandOfTheSurface) {
  const TexturedSoup input = textured(three_balls());
  for (const SetOperation operation : {SetOperation::unite, SetOperation::intersect,
                                       SetOperation::subtract, SetOperation::exclude}) {
    for (const bool by_trees : {false, true}) {
      const TexturedSurface result = combined(input, operation, by_trees);
      ASSERT_FALSE(result.surface.mesh.triangles.empty());
      expect_same_on_surface(input, result, 500);
    }
  }
}

// The same soup, put together of its parts.
TEST(BooleanAttributes, AttributesAreAppendedAsIfReadAtOnce) {
  Attributes all;
  std::size_t triangles = 0;
  TriangleSoup soup;
  for (const TriangleSoup& part : three_balls()) {
    TexturedSoup one = textured({part});
    one.attributes.materials.names[0] = "of " + std::to_string(triangles);
    append_attributes(all, triangles, std::move(one.attributes), part.triangles.size());
    append(soup, part);
    triangles += part.triangles.size();
  }
  ASSERT_EQ(all.corners.size(), 3u);
  EXPECT_EQ(value_bits(all.corners[0]), value_bits(texture_of(soup)));
  EXPECT_EQ(value_bits(all.corners[1]), value_bits(normals_of(soup)));
  EXPECT_EQ(all.materials.names.size(), 3u);
  EXPECT_EQ(all.groups.names.size(), 1u);  // of one name
  EXPECT_EQ(names_of(all.materials)[soup.triangles.size() - 1],
            "of " + std::to_string(triangles - three_balls()[2].triangles.size()));
}

TEST(BooleanAttributes, PartsWithoutAttributesKeepOthersInStep) {
  const TriangleSoup ball = sphere(300);
  Attributes all;
  append_attributes(all, 0, {}, ball.triangles.size());
  EXPECT_TRUE(all.empty());
  TexturedSoup second = textured({ball});
  append_attributes(all, ball.triangles.size(), second.attributes, ball.triangles.size());
  append_attributes(all, 2 * ball.triangles.size(), {}, ball.triangles.size());
  for (const CornerAttribute& attribute : all.corners) {
    ASSERT_EQ(attribute.of_corner.size(), 9 * ball.triangles.size());
    EXPECT_EQ(attribute.of_corner.front(), kNone);
    EXPECT_EQ(attribute.of_corner.back(), kNone);
  }
  const auto names = names_of(all.materials);
  ASSERT_EQ(names.size(), 3 * ball.triangles.size());
  EXPECT_EQ(names.front(), "-");
  EXPECT_EQ(names[ball.triangles.size()], "material 0");
  EXPECT_EQ(names.back(), "-");
}

TEST(BooleanAttributes, MaterialsOfOneNameThatLookDifferentStayApart) {
  Attributes all, red, blue;
  red.materials = labels_of({"paint"}, {0});
  red.looks = {{{1, 0, 0, 1}, kNone}};
  blue.materials = labels_of({"paint"}, {0});
  blue.looks = {{{0, 0, 1, 1}, kNone}};
  append_attributes(all, 0, red, 1);
  append_attributes(all, 1, blue, 1);
  append_attributes(all, 2, red, 1);
  EXPECT_EQ(names_of(all.materials), (std::vector<std::string>{"paint", "paint_2", "paint"}));
  EXPECT_EQ(all.looks.size(), 2u);
}

}  // namespace
}  // namespace meshrepair
