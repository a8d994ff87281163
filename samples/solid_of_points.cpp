// Makes a solid of a point cloud.
//
//   solid_of_points IN OUT
//
// One idea: points become a triangle soup, each point with its neighbours, and the repair makes a
// solid of that as of any other soup.
#include <cstdio>
#include <exception>

#include <mesh/point_io.h>
#include <mesh/soup_io.h>
#include <points/point_soup.h>
#include <repair/repair.h>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: solid_of_points IN OUT\n", stderr);
    return 2;
  }
  try {
    const meshrepair::PointReadResult scan = meshrepair::read_points(argv[1]);
    meshrepair::PointSoupReport report;
    const meshrepair::PointSoup points = meshrepair::make_point_soup(scan.cloud, {}, report);
    const meshrepair::RepairResult solid = meshrepair::repair(points.soup);
    meshrepair::write_soup(solid.surface.mesh, argv[2]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "solid_of_points: %s\n", error.what());
    return 1;
  }
}
