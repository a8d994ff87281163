// SPDX-License-Identifier: MIT
#include "appearance.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include <base/ids.h>
#include <check/mesh_distance.h>

namespace meshrepair::internal {
namespace {

using Kind = CornerAttribute::Kind;

// A picture that is shifted along the surface is seen less than one that is bent with it.
constexpr double kOfTexture = 0.1;

// Black beside white is as bad as a surface that is off by this share of the diagonal.
constexpr double kOfColour = 0.02;

// Values of whole triangles jump at their edges anyhow.
bool is_weighed(const CornerAttribute& attribute) {
  const bool is_seen = attribute.kind == Kind::texture || attribute.kind == Kind::colour;
  const auto& values = attribute.of_corner;
  return is_seen && attribute.place != CornerAttribute::Place::triangle &&
         std::find(values.begin(), values.end(), kNone) == values.end();
}

// How long a unit of the texture is on the surface, by their areas.
double length_of_texture(const TriangleSoup& mesh, const CornerAttribute& texture) {
  double on_surface = 0, in_picture = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& c = mesh.triangles[t];
    on_surface +=
        (mesh.points[c[1]] - mesh.points[c[0]]).cross(mesh.points[c[2]] - mesh.points[c[0]]).norm();
    const auto at = [&](std::size_t k) {
      const double* const uv =
          texture.values.data() + texture.components * texture.of_corner[3 * t + k];
      return Eigen::Vector2d(uv[0], uv[1]);
    };
    const Eigen::Vector2d ab = at(1) - at(0), ac = at(2) - at(0);
    in_picture += std::abs(ab.x() * ac.y() - ab.y() * ac.x());
  }
  return in_picture > 0 ? std::sqrt(on_surface / in_picture) : 0;
}

}  // namespace

Appearance appearance_of(const Surface& surface, const Attributes& carried) {
  Appearance appearance;
  std::vector<const CornerAttribute*> weighed;
  std::vector<double> lengths;
  for (const CornerAttribute& attribute : carried.corners) {
    if (!is_weighed(attribute)) continue;
    weighed.push_back(&attribute);
    lengths.push_back(attribute.kind == Kind::texture
                          ? kOfTexture * length_of_texture(surface.mesh, attribute)
                          : kOfColour * bounding_diagonal(surface.mesh));
    appearance.of_corner += attribute.components;
  }
  appearance.values.reserve(3 * surface.mesh.triangles.size() * appearance.of_corner);
  for (std::size_t corner = 0; corner < 3 * surface.mesh.triangles.size(); ++corner) {
    for (std::size_t i = 0; i < weighed.size(); ++i) {
      const CornerAttribute& attribute = *weighed[i];
      const std::size_t first = attribute.components * attribute.of_corner[corner];
      for (std::size_t k = 0; k < attribute.components; ++k) {
        appearance.values.push_back(lengths[i] * attribute.values[first + k]);
      }
    }
  }
  return appearance;
}

}  // namespace meshrepair::internal
