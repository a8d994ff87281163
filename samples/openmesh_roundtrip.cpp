// SPDX-License-Identifier: MIT
// Hands a mesh to OpenMesh, improves it there and takes it back.
//
//   openmesh_roundtrip IN OUT
//
// One idea: a soup is all that the readers and writers know; a half-edge mesh, for algorithms that
// walk over neighbours, is one call away, and so is the way back. The algorithm here moves each
// inner vertex half-way to the mean of its neighbours.
#include <cstdio>
#include <exception>
#include <vector>

#include <base/error.h>
#include <mesh/openmesh.h>
#include <mesh/soup_io.h>

namespace {

using meshrepair::TriMesh;

void smooth(TriMesh& mesh) {
  std::vector<TriMesh::Point> moved;
  moved.reserve(mesh.n_vertices());
  for (const auto vertex : mesh.vertices()) {
    TriMesh::Point sum(0, 0, 0);
    for (const auto neighbour : vertex.vertices()) sum += mesh.point(neighbour);
    const TriMesh::Point here = mesh.point(vertex);
    const bool fixed = vertex.is_boundary() || vertex.valence() == 0;
    moved.push_back(fixed ? here : (here + sum / static_cast<double>(vertex.valence())) / 2.0);
  }
  for (const auto vertex : mesh.vertices()) {
    mesh.set_point(vertex, moved[static_cast<std::size_t>(vertex.idx())]);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: openmesh_roundtrip IN OUT\n", stderr);
    return 2;
  }
  try {
    const meshrepair::ReadResult input = meshrepair::read_soup(argv[1]);
    TriMesh mesh = meshrepair::to_openmesh(input.soup);
    smooth(mesh);
    meshrepair::write_soup(meshrepair::from_openmesh(mesh), argv[2]);
    std::printf("%zu vertices, %zu edges, %zu faces\n", mesh.n_vertices(), mesh.n_edges(),
                mesh.n_faces());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "openmesh_roundtrip: %s\n", error.what());
    return 1;
  }
}
