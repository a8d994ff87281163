// Uses the installed libraries: reads a mesh and takes it through OpenMesh.
#include <cstdio>
#include <exception>

#include <bsp/openmesh.h>
#include <bsp/soup_io.h>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    const meshrepair::ReadResult result = meshrepair::read_soup(argv[1]);
    const meshrepair::TriMesh mesh = meshrepair::to_openmesh(result.soup);
    std::printf("%zu points, %zu triangles\n", mesh.n_vertices(), mesh.n_faces());
    return mesh.n_faces() == result.soup.triangles.size() ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
