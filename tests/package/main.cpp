// SPDX-License-Identifier: MIT
// Uses the installed libraries: repairs a cube, which changes nothing about it, takes it through
// OpenMesh, and draws it.
#include <cmath>
#include <cstdio>
#include <exception>

#include <mesh/openmesh.h>
#include <mesh/soup_io.h>
#include <picture/draw_mesh.h>
#include <picture/png_io.h>
#include <repair/repair.h>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    const meshrepair::ReadResult cube = meshrepair::read_soup(argv[1]);
    const meshrepair::RepairResult result = meshrepair::repair(cube.soup);
    const meshrepair::TriMesh mesh = meshrepair::to_openmesh(result.surface.mesh);
    const double volume = result.report.output_volume;
    std::printf("%zu points, %zu triangles, volume %g\n", mesh.n_vertices(), mesh.n_faces(),
                volume);
    const bool closed = result.report.output.closed() && result.report.output.manifold();
    meshrepair::Textures textures;
    const meshrepair::Camera camera(meshrepair::View(), {40, 30}, {&cube.soup});
    const meshrepair::Pixels pixels = meshrepair::draw_mesh(cube.soup, {}, camera, textures);
    if (meshrepair::format_png(pixels).empty()) return 1;
    return closed && mesh.n_faces() >= 12 && std::abs(volume - 1) < 1e-12 ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
