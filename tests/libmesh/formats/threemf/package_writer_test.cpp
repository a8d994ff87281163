// SPDX-License-Identifier: MIT
#include "formats/threemf/package_writer.h"

#include <gmock/gmock.h>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace meshrepair {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(PackageWriter, EachPartHasItsTypeByItsExtensionOrAlone) {
  KeptPackage kept;
  kept.parts = {{"a/x.png", "image/png", nullptr},
                {"a/y.png", "image/x-other", nullptr},
                {"a/z", "text/plain", nullptr},
                {"w.dat", "", nullptr}};
  const std::vector<WrittenPicture> pictures = {{"3D/Textures/0.jpg", "image/jpeg", nullptr, 0}};
  const std::string types = PackageWriter(&kept, pictures).content_types();
  EXPECT_THAT(types, HasSubstr("<Default Extension=\"png\" ContentType=\"image/png\"/>"));
  EXPECT_THAT(types, HasSubstr("<Default Extension=\"jpg\" ContentType=\"image/jpeg\"/>"));
  EXPECT_THAT(types, HasSubstr("Extension=\"dat\" ContentType=\"application/octet-stream\""));
  EXPECT_THAT(types, HasSubstr("<Override PartName=\"/a/y.png\" ContentType=\"image/x-other\"/>"));
  EXPECT_THAT(types, HasSubstr("<Override PartName=\"/a/z\" ContentType=\"text/plain\"/>"));
  EXPECT_THAT(types, Not(HasSubstr("x.png")));
}

TEST(PackageWriter, RelationshipsNameTheModelFirst) {
  KeptPackage kept;
  kept.of_package = {{"of a kind", "a b.png"}};
  const std::vector<WrittenPicture> pictures;
  PackageWriter writer(&kept, pictures);
  const std::string links = writer.of_package();
  EXPECT_THAT(links, HasSubstr("Target=\"/3D/3dmodel.model\" Id=\"rel0\""));
  EXPECT_THAT(links, HasSubstr("Target=\"/a%20b.png\" Id=\"rel1\" Type=\"of a kind\"/>"));
  EXPECT_THAT(links, EndsWith("</Relationships>\n"));
}

TEST(PackageWriter, AModelWithoutRelationshipsHasNoPartForThem) {
  std::vector<WrittenPicture> pictures;
  EXPECT_EQ(PackageWriter(nullptr, pictures).of_model({}), "");
  pictures = {{"3D/Textures/0.png", "image/png", nullptr, 0}};
  PackageWriter writer(nullptr, pictures);
  EXPECT_THAT(writer.of_model({}), HasSubstr("Target=\"/3D/Textures/0.png\" Id=\"rel0\""));
}

TEST(PackageWriter, ThumbnailsOfObjectsAreNamedOnce) {
  KeptPackage kept;
  kept.of_model = {{"of a kind", "a.png"}};
  const std::vector<WrittenPicture> pictures;
  PackageWriter writer(&kept, pictures);
  const std::string links = writer.of_model({"A.png", "b.png", "b.png"});
  EXPECT_THAT(links,
              HasSubstr("Target=\"/b.png\" Id=\"rel1\" Type=\"http://schemas.openxmlformats"));
  EXPECT_THAT(links, Not(HasSubstr("rel2")));
}

}  // namespace
}  // namespace meshrepair
