// SPDX-License-Identifier: MIT
#include <cmath>
#include <gmock/gmock.h>
#include <numbers>
#include <string>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <mesh/soup_io.h>
#include <mesh/topology.h>

#include "package_bytes.h"
#include "warning_texts.h"

namespace meshrepair {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

// Two points 10 apart, not along an axis, and one 10 from both, with a lattice between.
ReadResult read_lattice(const std::string& attributes, const std::string& content,
                        std::size_t sides = 128) {
  const std::string object =
      "<object id=\"1\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/>"
      "<vertex x=\"6\" y=\"0\" z=\"8\"/><vertex x=\"0\" y=\"10\" z=\"0\"/></vertices>"
      "<b:beamlattice xmlns:b=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02\" "
      "minlength=\"0.001\" " +
      attributes + ">" + content + "</b:beamlattice></mesh></object>";
  ReadOptions options;
  options.beam_sides = sides;
  options.attributes = true;
  return read_soup(package_of(model_of(object, item_of(1))), "a.3mf", options);
}

std::string beam(const std::string& attributes) {
  return "<b:beams><b:beam v1=\"0\" v2=\"1\" " + attributes + "/></b:beams>";
}

double volume_of(const std::string& attributes, const std::string& content) {
  const ReadResult read = read_lattice(attributes, content);
  EXPECT_THAT(texts(read.report.warnings), ElementsAre());
  const Topology topology = examine_topology(read.soup.triangles, read.soup.points.size());
  EXPECT_TRUE(topology.closed() && topology.manifold() && topology.oriented());
  return signed_volume(read.soup);
}

// As bodies overlap, ends that are spheres count twice.
TEST(BeamLattice, BodiesHaveTheirVolumes) {
  const double tube = kPi * 10, cone = kPi * 10 / 3 * (4 + 2 + 1);
  const double tolerance = 2e-3;
  EXPECT_NEAR(volume_of("radius=\"1\" cap=\"butt\"", beam("")) / tube, 1, tolerance);
  EXPECT_NEAR(volume_of("radius=\"9\" cap=\"butt\"", beam("r1=\"1\"")) / tube, 1, tolerance);
  EXPECT_NEAR(volume_of("radius=\"9\" cap=\"butt\"", beam("r1=\"2\" r2=\"1\"")) / cone, 1,
              tolerance);
  EXPECT_NEAR(volume_of("radius=\"9\" cap=\"butt\"", beam("r2=\"1\" r1=\"2\"")) / cone, 1,
              tolerance);
  const double halves = 2 * kPi / 3 * (8 + 1), ball = 4 * kPi / 3;
  EXPECT_NEAR(
      volume_of("radius=\"1\"", beam("cap1=\"hemisphere\" cap2=\"hemisphere\" r1=\"2\" r2=\"1\"")) /
          (cone + halves),
      1, tolerance);
  EXPECT_NEAR(volume_of("radius=\"1\"", beam("")) / (tube + 2 * ball), 1, tolerance);
  EXPECT_NEAR(volume_of("radius=\"1\"", beam("cap1=\"butt\"")) / (tube + ball), 1, tolerance);
}

TEST(BeamLattice, BallsAreWhereTheModeSays) {
  const double tube = kPi * 10, ball = 4 * kPi / 3;
  const std::string balls =
      beam("") + "<b:balls><b:ball vindex=\"1\" r=\"3\"/><b:ball vindex=\"2\"/></b:balls>";
  const std::string lattice = "radius=\"1\" cap=\"butt\" ballradius=\"2\" ballmode=";
  EXPECT_NEAR(volume_of(lattice + "\"none\"", balls) / tube, 1, 2e-3);
  EXPECT_NEAR(volume_of(lattice + "\"mixed\"", balls) / (tube + (27 + 8) * ball), 1, 2e-3);
  EXPECT_NEAR(volume_of(lattice + "\"all\"", balls) / (tube + (8 + 27 + 8) * ball), 1, 2e-3);
}

TEST(BeamLattice, CornersLieOnTheRoundSurface) {
  for (const std::size_t sides : {3U, 4U, 7U, 16U}) {
    const ReadResult read = read_lattice("radius=\"1\" cap=\"butt\"", beam(""), sides);
    ASSERT_EQ(read.soup.triangles.size(), 4 * sides - 4);
    const Vec3d axis = Vec3d(6, 0, 8) / 10;
    for (std::size_t p = 3; p < read.soup.points.size(); ++p) {
      EXPECT_NEAR(read.soup.points[p].cross(axis).norm(), 1, 1e-14);
    }
  }
}

TEST(BeamLattice, WhatIsNoBeamIsLeftOutAndSaid) {
  const ReadResult read =
      read_lattice("radius=\"1\"",
                   "<b:beams><b:beam v1=\"0\" v2=\"1\"/><b:beam v1=\"0\" v2=\"9\"/>"
                   "<b:beam v1=\"1\"/><b:beam v1=\"0\" v2=\"2\" r1=\"nan\"/>"
                   "<b:beam v1=\"0\" v2=\"2\" r1=\"-1\"/><b:beam v1=\"2\" v2=\"2\"/></b:beams>");
  EXPECT_THAT(texts(read.report.warnings), ElementsAre(HasSubstr("4 beams left out")));
  EXPECT_EQ(read.report.warnings[0].code, WarningCode::faces_unreadable);
  const ReadResult clipped =
      read_lattice("radius=\"1\" clippingmode=\"inside\" clippingmesh=\"7\"", beam(""));
  EXPECT_THAT(texts(clipped.report.warnings),
              ElementsAre(HasSubstr("1 beam lattice not cut by the mesh that clips it")));
}

}  // namespace
}  // namespace meshrepair
