// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <mesh/region_mesh.h>

namespace meshrepair {
namespace {

// Two tetrahedra with a face in common, and a void in the second, as far as seeds tell.
struct Pair {
  TriangleSoup mesh = {
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{{0, 1, 2}}, {{0, 1, 3}}, {{1, 2, 3}}, {{2, 0, 3}}, {{1, 0, 4}}, {{2, 1, 4}}, {{0, 2, 4}}}};
  std::vector<std::array<std::uint32_t, 2>> parts_of = {{1, 2}, {0, 1}, {0, 1}, {0, 1},
                                                        {0, 2}, {0, 2}, {0, 2}};
  std::vector<std::uint32_t> region_of_part = {0, 1, 2, 0};
  std::vector<std::string> names = {"upper part", "lower\""};
  std::vector<RegionSeed> seeds = {
      {1, {0.1, 0.1, 0.25}}, {2, {0.1, 0.1, -0.25}}, {0, {0.1, 0.1, -0.5}}};

  [[nodiscard]] std::string text(RegionFormat format) const {
    return format_region_mesh({mesh, parts_of, region_of_part, names, seeds}, format, comments);
  }
  std::vector<std::string> comments = {"by -- hand"};
};

TEST(RegionMesh, ExtensionsTellFormats) {
  EXPECT_EQ(region_format_of("a/b.MSH"), RegionFormat::msh);
  EXPECT_EQ(region_format_of("b.poly"), RegionFormat::poly);
  EXPECT_EQ(region_format_of("b.stl"), std::nullopt);
  EXPECT_EQ(region_format_of("vtp"), std::nullopt);
  EXPECT_EQ(region_format_of("a.vtp/b"), std::nullopt);
  EXPECT_EQ(region_format_name(RegionFormat::vtp), "VTP");
}

TEST(RegionMesh, ObjHasAGroupForEachRegionOfAFace) {
  EXPECT_EQ(Pair().text(RegionFormat::obj),
            "# by -- hand\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 0 -1\n"
            "g upper_part\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"
            "g lower_\nf 2 1 5\nf 3 2 5\nf 1 3 5\n"
            "g upper_part lower_\nf 1 2 3\n");
}

TEST(RegionMesh, PolyHasMarkersHolesAndRegions) {
  EXPECT_EQ(Pair().text(RegionFormat::poly),
            "# by -- hand\n5 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 0 0 -1\n7 1\n"
            "# marker 1: outside upper_part\n1 0 1\n3 0 1 3\n1 0 1\n3 1 2 3\n1 0 1\n3 2 0 3\n"
            "# marker 2: outside lower_\n1 0 2\n3 1 0 4\n1 0 2\n3 2 1 4\n1 0 2\n3 0 2 4\n"
            "# marker 3: upper_part lower_\n1 0 3\n3 0 1 2\n"
            "1\n1 0.1 0.1 -0.5\n"
            "2\n1 0.1 0.1 0.25 1\n2 0.1 0.1 -0.25 2\n");
}

TEST(RegionMesh, MshHasNamedSurfacesAndItsScriptVolumes) {
  const std::string text = Pair().text(RegionFormat::msh);
  EXPECT_NE(text.find("$PhysicalNames\n3\n2 1 \"upper_part\"\n2 2 \"lower_\"\n"
                      "2 3 \"upper_part|lower_\"\n$EndPhysicalNames\n"
                      "$Entities\n0 0 3 0\n1 0 0 0 1 1 1 1 1 0\n2 0 0 -1 1 1 0 1 2 0\n"
                      "3 0 0 0 1 1 0 1 3 0\n$EndEntities\n"),
            std::string::npos);
  EXPECT_NE(text.find("$Nodes\n3 5 1 5\n2 1 0 4\n1\n2\n4\n3\n"), std::string::npos);
  EXPECT_NE(text.find("$Elements\n3 7 1 7\n2 1 2 3\n1 1 2 4\n"), std::string::npos);
  const Pair pair;
  EXPECT_EQ(format_gmsh_script(
                {pair.mesh, pair.parts_of, pair.region_of_part, pair.names, pair.seeds}, "a.msh"),
            "Merge \"a.msh\";\n"
            "Surface Loop(1) = {1, 3};\nVolume(1) = {1};\n"
            "Surface Loop(2) = {2, 3};\nVolume(2) = {2};\n"
            "Physical Volume(\"upper_part\", 1) = {1};\nPhysical Volume(\"lower_\", 2) = {2};\n");
}

TEST(RegionMesh, VtpAndPlyHaveTheRegionsOfEachFace) {
  const std::string vtp = Pair().text(RegionFormat::vtp);
  EXPECT_NE(vtp.find("<!-- by __ hand -->\n"), std::string::npos);
  EXPECT_NE(
      vtp.find("Name=\"front\" NumberOfComponents=\"1\" format=\"ascii\">\n1\n0\n0\n0\n0\n0\n0\n"),
      std::string::npos);
  EXPECT_NE(
      vtp.find("Name=\"behind\" NumberOfComponents=\"1\" format=\"ascii\">\n2\n1\n1\n1\n2\n2\n2\n"),
      std::string::npos);
  const std::string ply = Pair().text(RegionFormat::ply);
  const std::size_t header = ply.find("end_header\n") + 11;
  EXPECT_NE(ply.find("comment region 1 upper_part\ncomment region 2 lower_\n"), std::string::npos);
  EXPECT_EQ(ply.size(), header + 5 * 24 + 7 * (1 + 12 + 8));
}

}  // namespace
}  // namespace meshrepair
