// SPDX-License-Identifier: MIT
// The readers of points, and the local triangulation of what they read.
#include <array>

#include <mesh/point_io.h>
#include <points/point_soup.h>

#include "check_reading.h"

namespace meshrepair::testing {
namespace {

void require_consistent(const PointReadResult& result) {
  const PointCloud& cloud = result.cloud;
  const PointReadReport& report = result.report;
  require(!cloud.points.empty(), "a cloud without points was not refused");
  require(cloud.points.size() <= report.bytes, "more points than bytes");
  require(cloud.normals.empty() || cloud.normals.size() == cloud.points.size(),
          "not as many normals as points");
  require(cloud.colours.empty() || cloud.colours.size() == cloud.points.size(),
          "not as many colours as points");
  for (const Warning& warning : report.warnings) require_one_line(warning.text);
  const std::size_t lost = report.bad_points + report.missing_points + report.trailing_bytes;
  require(lost == 0 || !report.warnings.empty(), "something was lost without a warning");
}

void check_triangulation(const PointCloud& cloud) {
  constexpr std::size_t kMostPoints = 500;
  if (cloud.points.size() > kMostPoints) return;
  try {
    PointSoupReport report;
    PointSoupOptions options;
    options.project = static_cast<int>(cloud.points.size() % 2);
    const PointSoup result = make_point_soup(cloud, options, report);
    require_valid_indices(result.soup);
    require(result.votes.size() == result.soup.triangles.size(), "not as many votes as triangles");
    require(report.points == result.soup.points.size(), "another number of points");
    for (const Vec3d& p : result.soup.points) require(p.allFinite(), "a point is not finite");
  } catch (const NoSolidError& error) {
    require_one_line(error.what());
  }
}

void check_points(std::string_view bytes, const std::string& name) {
  try {
    const PointReadResult result = read_points(bytes, name, {.colours = true});
    require_consistent(result);
    check_triangulation(result.cloud);
  } catch (const InputError& error) {
    require_one_line(error.what());
  }
  try {
    const MeshOrPoints either = read_mesh_or_points(bytes, name);
    require(either.mesh.has_value() != either.points.has_value(), "not one of the two");
  } catch (const InputError& error) {
    require_one_line(error.what());
  }
}

}  // namespace
}  // namespace meshrepair::testing

// The first byte chooses the name, the others are the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static constexpr std::array<const char*, 6> kNames = {"any.xyz", "any.pts", "any.pcd",
                                                        "any.ply", "any.obj", "any"};
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  meshrepair::testing::check_points(bytes, kNames[data[0] % kNames.size()]);
  return 0;
}
