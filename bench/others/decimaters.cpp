// SPDX-License-Identifier: MIT
// Solids with fewer triangles by decimate(), meshoptimizer, OpenMesh and CGAL: how far from the
// solid, what is broken, time and memory. Each runs in a process of its own.
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <meshoptimizer.h>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include <check/check_surface.h>
#include <check/mesh_distance.h>
#include <mesh/soup_io.h>
#include <simplify/decimate.h>

namespace {

using namespace meshrepair;

TriangleSoup by_us(const TriangleSoup& mesh, std::size_t count) {
  DecimationOptions options;
  options.triangles = count;
  options.precision = Precision::float32;
  DecimationReport report;
  return decimate(mesh, options, report).mesh;
}

TriangleSoup by_meshoptimizer(const TriangleSoup& mesh, std::size_t count) {
  std::vector<float> places;
  for (const Vec3d& p : mesh.points) {
    for (int k = 0; k < 3; ++k) places.push_back(static_cast<float>(p[k]));
  }
  std::vector<unsigned> corners;
  for (const auto& t : mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
  std::vector<unsigned> left(corners.size());
  left.resize(meshopt_simplify(left.data(), corners.data(), corners.size(), places.data(),
                               mesh.points.size(), 3 * sizeof(float), 3 * count, 1e9f, 0, nullptr));
  TriangleSoup result{mesh.points, {}};
  for (std::size_t i = 0; i < left.size(); i += 3) {
    result.triangles.push_back({left[i], left[i + 1], left[i + 2]});
  }
  return result;
}

TriangleSoup by_openmesh(const TriangleSoup& mesh, std::size_t count) {
  using Mesh = OpenMesh::TriMesh_ArrayKernelT<>;
  Mesh all;
  std::vector<Mesh::VertexHandle> points;
  for (const Vec3d& p : mesh.points) {
    points.push_back(all.add_vertex(Mesh::Point(
        static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()))));
  }
  for (const auto& t : mesh.triangles) all.add_face(points[t[0]], points[t[1]], points[t[2]]);
  OpenMesh::Decimater::DecimaterT<Mesh> decimater(all);
  OpenMesh::Decimater::ModQuadricT<Mesh>::Handle quadrics;
  decimater.add(quadrics);
  decimater.module(quadrics).unset_max_err();
  decimater.initialize();
  decimater.decimate_to_faces(0, count);
  all.garbage_collection();
  TriangleSoup result;
  for (const auto v : all.vertices()) {
    const auto& p = all.point(v);
    result.points.emplace_back(p[0], p[1], p[2]);
  }
  for (const auto f : all.faces()) {
    std::array<std::uint32_t, 3> corners{};
    std::size_t k = 0;
    for (const auto v : all.fv_range(f)) corners[k++] = static_cast<std::uint32_t>(v.idx());
    result.triangles.push_back(corners);
  }
  return result;
}

TriangleSoup by_cgal(const TriangleSoup& mesh, std::size_t count) {
  using Point = CGAL::Simple_cartesian<double>::Point_3;
  using Mesh = CGAL::Surface_mesh<Point>;
  Mesh all;
  std::vector<Mesh::Vertex_index> points;
  for (const Vec3d& p : mesh.points) points.push_back(all.add_vertex(Point(p.x(), p.y(), p.z())));
  for (const auto& t : mesh.triangles) all.add_face(points[t[0]], points[t[1]], points[t[2]]);
  namespace Simplification = CGAL::Surface_mesh_simplification;
  Simplification::edge_collapse(all, Simplification::Count_stop_predicate<Mesh>(3 * count / 2));
  all.collect_garbage();
  TriangleSoup result;
  for (const auto v : all.vertices()) {
    const Point& p = all.point(v);
    result.points.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto f : all.faces()) {
    std::array<std::uint32_t, 3> corners{};
    std::size_t k = 0;
    for (const auto v : all.vertices_around_face(all.halfedge(f))) {
      corners[k++] = static_cast<std::uint32_t>(std::size_t{v});
    }
    result.triangles.push_back(corners);
  }
  return result;
}

struct Way {
  const char* name;
  TriangleSoup (*run)(const TriangleSoup&, std::size_t);
};

constexpr Way kWays[] = {{"meshrepair", by_us},
                         {"meshoptimizer", by_meshoptimizer},
                         {"OpenMesh", by_openmesh},
                         {"CGAL", by_cgal}};

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

void print_row(const char* mesh_name, const TriangleSoup& mesh, const Way& way, std::size_t count) {
  const double before = cpu_seconds();
  const TriangleSoup fewer = way.run(mesh, count);
  const double seconds = cpu_seconds() - before;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const MeshDistance distance = mesh_distance(mesh, fewer);
  const SurfaceCheck check = check_surface(fewer);
  const double unit = 1e-6 * distance.diagonal;
  std::printf("| %s | %zu | %s | %zu | %.1f | %.0f | %zu | %zu | %.3f | %ld |\n", mesh_name,
              mesh.triangles.size(), way.name, fewer.triangles.size(),
              std::max(distance.forth.mean, distance.back.mean) / unit, distance.largest() / unit,
              check[Defect::self_intersection].count, check[Defect::nonmanifold_edge].count,
              seconds, usage.ru_maxrss / 1024);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr,
                 "Usage: decimaters SHARE SOLID...\n\nSHARE of the triangles stay, such as 0.1.\n");
    return 2;
  }
  const double share = std::atof(argv[1]);
  std::printf(
      "| solid | triangles | by | left | mean, 1e-6 of the diagonal | largest | intersecting pairs "
      "| "
      "non-manifold edges | CPU, s | MB |\n|---|---|---|---|---|---|---|---|---|---|\n");
  std::fflush(stdout);
  for (int i = 2; i < argc; ++i) {
    const std::filesystem::path path(argv[i]);
    const TriangleSoup mesh = read_soup(path, ReadOptions()).soup;
    const auto count = static_cast<std::size_t>(share * static_cast<double>(mesh.triangles.size()));
    for (const Way& way : kWays) {
      const pid_t child = fork();
      if (child == 0) {
        print_row(path.stem().c_str(), mesh, way, count);
        _exit(0);
      }
      int status = 0;
      waitpid(child, &status, 0);
      if (status != 0) std::printf("| %s | | %s | failed |\n", path.stem().c_str(), way.name);
    }
  }
}
