// SPDX-License-Identifier: MIT
// cgal_points CLOUD.xyz OUT front|poisson: a surface through points by CGAL, for comparison. Prints
// a line of JSON; exit code 1 where CGAL gives no surface.
#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/compute_average_spacing.h>
#include <CGAL/mst_orient_normals.h>
#include <CGAL/pca_estimate_normals.h>
#include <CGAL/poisson_surface_reconstruction.h>
#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using PointWithNormal = std::pair<Point, Kernel::Vector_3>;
using Triangle = std::array<std::size_t, 3>;

constexpr unsigned kNeighbours = 18;

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::vector<Point> read_points(const char* path) {
  std::vector<Point> points;
  std::ifstream file(path);
  for (double x = 0, y = 0, z = 0; file >> x >> y >> z;) points.emplace_back(x, y, z);
  return points;
}

bool by_advancing_front(const std::vector<Point>& points, Mesh& mesh) {
  std::vector<Triangle> triangles;
  CGAL::advancing_front_surface_reconstruction(points.begin(), points.end(),
                                               std::back_inserter(triangles));
  std::vector<Point> corners = points;
  CGAL::Polygon_mesh_processing::orient_polygon_soup(corners, triangles);
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(corners, triangles, mesh);
  return num_faces(mesh) > 0;
}

bool by_poisson(const std::vector<Point>& points, Mesh& mesh) {
  std::vector<PointWithNormal> list;
  for (const Point& p : points) list.emplace_back(p, Kernel::Vector_3(0, 0, 0));
  const auto maps = CGAL::parameters::point_map(CGAL::First_of_pair_property_map<PointWithNormal>())
                        .normal_map(CGAL::Second_of_pair_property_map<PointWithNormal>());
  CGAL::pca_estimate_normals<CGAL::Sequential_tag>(list, kNeighbours, maps);
  list.erase(CGAL::mst_orient_normals(list, kNeighbours, maps), list.end());
  const double spacing = CGAL::compute_average_spacing<CGAL::Sequential_tag>(
      list, 6, CGAL::parameters::point_map(CGAL::First_of_pair_property_map<PointWithNormal>()));
  return CGAL::poisson_surface_reconstruction_delaunay(
      list.begin(), list.end(), CGAL::First_of_pair_property_map<PointWithNormal>(),
      CGAL::Second_of_pair_property_map<PointWithNormal>(), mesh, spacing);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "Usage: cgal_points CLOUD.xyz OUT front|poisson\n");
    return 2;
  }
  const std::vector<Point> points = read_points(argv[1]);
  Mesh mesh;
  const double start = seconds();
  const bool found =
      std::string(argv[3]) == "front" ? by_advancing_front(points, mesh) : by_poisson(points, mesh);
  const double spent = seconds() - start;
  if (!found) return 1;
  CGAL::IO::write_polygon_mesh(argv[2], mesh, CGAL::parameters::stream_precision(17));
  std::printf("{\"seconds\": %.4f, \"triangles\": %zu, \"closed\": %s}\n", spent,
              static_cast<std::size_t>(num_faces(mesh)), CGAL::is_closed(mesh) ? "true" : "false");
  return 0;
}
