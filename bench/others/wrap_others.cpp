// SPDX-License-Identifier: MIT
// wrap_others alpha|openvdb IN OUT SHARE: a closed surface around a mesh by CGAL's alpha wrap or by
// OpenVDB, for comparison. SHARE of the diagonal is alpha, and 30 times the offset; or the side of
// a voxel. Prints the seconds that it took without reading and writing.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include <mesh/soup_io.h>

#include "openvdb_mesh.h"

using namespace meshrepair;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Wrap = CGAL::Surface_mesh<Kernel::Point_3>;

double diagonal_of(const TriangleSoup& soup) {
  Vec3d low = soup.points.front(), high = low;
  for (const Vec3d& p : soup.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

TriangleSoup alpha_wrapped(const TriangleSoup& soup, double alpha) {
  std::vector<Kernel::Point_3> points;
  for (const Vec3d& p : soup.points) points.emplace_back(p.x(), p.y(), p.z());
  std::vector<std::vector<std::size_t>> faces;
  for (const auto& t : soup.triangles) faces.push_back({t[0], t[1], t[2]});
  Wrap wrap;
  CGAL::alpha_wrap_3(points, faces, alpha, alpha / 30, wrap);
  TriangleSoup result;
  for (const auto v : wrap.vertices()) {
    const auto& p = wrap.point(v);
    result.points.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto f : wrap.faces()) {
    std::vector<std::uint32_t> corners;
    for (const auto v : vertices_around_face(wrap.halfedge(f), wrap)) {
      corners.push_back(static_cast<std::uint32_t>(v));
    }
    result.triangles.push_back({corners[0], corners[1], corners[2]});
  }
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string method = argc == 5 ? argv[1] : "";
  if (method != "alpha" && method != "openvdb") {
    std::fprintf(stderr, "Usage: wrap_others alpha|openvdb IN OUT SHARE\n");
    return 2;
  }
  const TriangleSoup soup = read_soup(argv[2]).soup;
  openvdb::initialize();
  const double length = std::strtod(argv[4], nullptr) * diagonal_of(soup);
  const auto start = std::chrono::steady_clock::now();
  const TriangleSoup result = method == "alpha" ? alpha_wrapped(soup, length)
                                                : bench::mesh_of(*bench::volume_of(soup, length));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  write_soup(result, argv[3]);
  std::printf("%.4f\n", took.count());
  return 0;
}
