// SPDX-License-Identifier: MIT
// Makes a solid of a point cloud.
//
//   solid_of_points IN OUT
//
// One idea: points become a triangle soup, each point with its neighbours, and the repair makes a
// solid of that as of any other soup. Where they enclose nothing, smoother ones and a base are
// tried.
#include <cstdio>
#include <exception>

#include <mesh/point_io.h>
#include <mesh/soup_io.h>
#include <repair/repair_points.h>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: solid_of_points IN OUT\n", stderr);
    return 2;
  }
  try {
    const meshrepair::PointReadResult scan = meshrepair::read_points(argv[1]);
    meshrepair::RepairPointsReport report;
    meshrepair::RepairReport repair;
    const meshrepair::PointSolid solid = meshrepair::repair_points(scan.cloud, {}, report, repair);
    meshrepair::write_soup(solid.surface.mesh, argv[2]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "solid_of_points: %s\n", error.what());
    return 1;
  }
}
