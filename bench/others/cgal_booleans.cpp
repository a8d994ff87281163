// SPDX-License-Identifier: MIT
// cgal_booleans A B OPERATION OUT [corefinement|nef]: the same as bspbool, by CGAL, for comparison.
// Prints a line of JSON; exit code 1 where CGAL gives no result.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/convert_nef_polyhedron_to_polygon_mesh.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <chrono>
#include <cstdio>
#include <exception>
#include <string>

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Inexact = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Inexact::Point_3>;
using ExactMesh = CGAL::Surface_mesh<Exact::Point_3>;
using Nef = CGAL::Nef_polyhedron_3<Exact>;

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool corefine(Mesh& a, Mesh& b, const std::string& operation, Mesh& out) {
  if (operation == "union") return pmp::corefine_and_compute_union(a, b, out);
  if (operation == "intersection") return pmp::corefine_and_compute_intersection(a, b, out);
  return pmp::corefine_and_compute_difference(a, b, out);
}

Nef nef_of(const Mesh& mesh) {
  ExactMesh exact;
  CGAL::copy_face_graph(mesh, exact);
  return Nef(exact);
}

bool by_nef(const Mesh& a, const Mesh& b, const std::string& operation, Mesh& out) {
  const Nef first = nef_of(a);
  const Nef second = nef_of(b);
  const Nef result = operation == "union"          ? first + second
                     : operation == "intersection" ? first * second
                                                   : first - second;
  ExactMesh exact;
  CGAL::convert_nef_polyhedron_to_polygon_mesh(result, exact, true);
  CGAL::copy_face_graph(exact, out);
  return true;
}

int run(char** argv, bool nef) {
  Mesh a, b, out;
  const double start = seconds();
  if (!CGAL::IO::read_polygon_mesh(argv[1], a) || !CGAL::IO::read_polygon_mesh(argv[2], b)) {
    std::printf("{\"error\": \"not read\"}\n");
    return 1;
  }
  pmp::triangulate_faces(a);
  pmp::triangulate_faces(b);
  const double read = seconds();
  const std::string operation = argv[3];
  const bool valid = nef ? by_nef(a, b, operation, out) : corefine(a, b, operation, out);
  const double done = seconds();
  if (!valid) {
    std::printf("{\"error\": \"the result is not manifold\", \"seconds\": %.4f}\n", done - read);
    return 1;
  }
  pmp::triangulate_faces(out);
  const bool closed = CGAL::is_closed(out);
  CGAL::IO::write_polygon_mesh(argv[4], out, CGAL::parameters::stream_precision(17));
  std::printf(
      "{\"read_seconds\": %.4f, \"seconds\": %.4f, \"triangles\": %zu, \"closed\": %s, "
      "\"volume\": %.17g}\n",
      read - start, done - read, static_cast<std::size_t>(num_faces(out)),
      closed ? "true" : "false", closed ? pmp::volume(out) : 0.0);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) {
    std::fprintf(stderr, "Usage: cgal_booleans A B union|intersection|difference OUT [nef]\n");
    return 2;
  }
  try {
    return run(argv, argc > 5 && std::string(argv[5]) == "nef");
  } catch (const std::exception& error) {
    std::string text = error.what();
    for (char& c : text) {
      if (c == '"' || c == '\\' || c == '\n') c = ' ';
    }
    std::printf("{\"error\": \"%s\"}\n", text.c_str());
    return 1;
  }
}
