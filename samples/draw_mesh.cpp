// SPDX-License-Identifier: MIT
// Draws a mesh as a picture, with its colours and textures.
//
//   draw_mesh IN OUT.png
//
// One idea: a camera that fits the mesh, the pixels that it sees, and the bytes of a PNG.
#include <cstdio>
#include <exception>
#include <filesystem>

#include <base/atomic_file.h>
#include <mesh/soup_io.h>
#include <picture/draw_mesh.h>
#include <picture/png_io.h>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: draw_mesh IN OUT.png\n", stderr);
    return 2;
  }
  try {
    meshrepair::ReadOptions options;
    options.attributes = true;
    const meshrepair::ReadResult input = meshrepair::read_soup(argv[1], options);
    const meshrepair::Camera camera(meshrepair::View(), {640, 480}, {&input.soup});
    meshrepair::Textures textures({std::filesystem::path(argv[1]).parent_path()});
    const meshrepair::Pixels pixels =
        meshrepair::draw_mesh(input.soup, input.attributes, camera, textures);
    meshrepair::write_file_atomically(argv[2], meshrepair::format_png(pixels));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "draw_mesh: %s\n", error.what());
    return 1;
  }
}
