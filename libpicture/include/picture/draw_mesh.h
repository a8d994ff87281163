// SPDX-License-Identifier: MIT
// A mesh as a picture.
//
// Rays are parallel, all surfaces are dull and opaque, and light comes from the upper left of
// whoever looks. Faces are flat, whatever normals they carry, for so they are in the file. Colours
// are those of materials, times those of corners unless all these are black, times the textures of
// materials, which repeat without end. What is seen from behind is red: a hole shows it, and a
// triangle that is turned.
//
// The same pixels on any number of threads, and from any compiler.
#pragma once

#include <base/progress.h>
#include <mesh/attributes.h>
#include <mesh/soup.h>
#include <picture/camera.h>
#include <picture/pixels.h>
#include <picture/textures.h>

namespace meshrepair {

struct DrawOptions {
  unsigned samples = 3;  // along each side of a pixel, whose colour is their mean; 1 to 8
  Rgba background = {255, 255, 255, 255};
  bool both_sides = false;  // what is seen from behind has its own colours, not red
  ProgressObserver* progress = nullptr;
};

// `attributes` are of the soup, or empty. Triangles with a corner that is not finite are left out,
// and those that are a thousand pictures away. Takes time for all samples that triangles cover,
// hidden ones, too, and 24 bytes for a point and up to 32 for a triangle.
[[nodiscard]] Pixels draw_mesh(const TriangleSoup& soup, const Attributes& attributes,
                               const Camera& camera, Textures& textures,
                               const DrawOptions& options = {});

}  // namespace meshrepair
