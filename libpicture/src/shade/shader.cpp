// SPDX-License-Identifier: MIT
#include "shade/shader.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <base/ids.h>

namespace meshrepair {
namespace {

constexpr Rgba kClay = {158, 186, 214, 255};  // where nothing has a colour
constexpr Rgba kFromBehind = {224, 74, 52, 255};

// In the axes of the camera: to the right, up, and towards whoever looks; of length 1.
constexpr std::array<double, 3> kLamp = {-0.28, 0.45, 0.848};
// Less than 1 together, so that white is not that of paper.
constexpr double kLampLight = 0.62;
constexpr double kSkyLight = 0.36;     // from above
constexpr double kGroundLight = 0.18;  // from below

double square(double share) {
  const double within = share > 0 ? std::min(share, 1.0) : 0;  // NaN: 0
  return within * within;
}

// Usable: of this soup, with the least number of components.
const CornerAttribute* find_usable(const Attributes& attributes, CornerAttribute::Kind kind,
                                   std::size_t components, const TriangleSoup& soup) {
  const CornerAttribute* const found = find_kind(attributes, kind);
  if (found == nullptr || found->components < components) return nullptr;
  return found->of_corner.size() == 3 * soup.triangles.size() ? found : nullptr;
}

// Programs that know of no colours write black ones, too.
bool is_black(const CornerAttribute& colours) {
  for (std::size_t i = 0; i < colours.values.size(); ++i) {
    if (i % colours.components < 3 && colours.values[i] > 0) return false;
  }
  return true;
}

// The first numbers of each corner's value; false where one has none.
template <std::size_t kCount>
bool values_of(const CornerAttribute& attribute, std::uint32_t triangle,
               std::array<std::array<double, kCount>, 3>& values) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t value = attribute.of_corner[3 * std::size_t{triangle} + k];
    if (value == kNone) return false;
    for (std::size_t i = 0; i < kCount; ++i) {
      values[k][i] = attribute.values[attribute.components * value + i];
    }
  }
  return true;
}

double mixed(const std::array<double, 3>& shares, double a, double b, double c) {
  return shares[0] * a + shares[1] * b + shares[2] * c;
}

}  // namespace

Shader::Shader(const TriangleSoup& soup, const Attributes& attributes,
               std::vector<std::shared_ptr<const Texture>> textures, const Camera& camera,
               const Options& options)
    : soup_(soup),
      attributes_(attributes),
      textures_(std::move(textures)),
      camera_(camera),
      samples_of_pixel_(static_cast<double>(options.samples) * options.samples),
      both_sides_(options.both_sides),
      places_(find_usable(attributes, CornerAttribute::Kind::texture, 2, soup)),
      colours_(find_usable(attributes, CornerAttribute::Kind::colour, 3, soup)) {
  if (colours_ != nullptr && is_black(*colours_)) colours_ = nullptr;
}

Shader::Face Shader::face(std::uint32_t triangle, bool from_behind) const {
  Face face;
  if (from_behind && !both_sides_) {
    face.light = light_of(kFromBehind);
  } else {
    add_look(triangle, face);
  }
  const double bright = brightness(triangle, from_behind);
  for (double& value : face.light) value *= bright;
  return face;
}

void Shader::add_look(std::uint32_t triangle, Face& face) const {
  add_colours(triangle, face);
  face.light = face.has_colours ? Light{1, 1, 1} : light_of(kClay);
  const auto& materials = attributes_.materials.of_triangle;
  const std::uint32_t material = triangle < materials.size() ? materials[triangle] : kNone;
  if (material >= attributes_.looks.size()) return;
  const Material& look = attributes_.looks[material];
  for (std::size_t k = 0; k < 3; ++k) face.light[k] = square(look.colour[k]);
  face.sampling = look.sampling;
  if (look.image < textures_.size()) add_texture(triangle, textures_[look.image].get(), face);
}

void Shader::add_colours(std::uint32_t triangle, Face& face) const {
  face.has_colours = colours_ != nullptr && values_of(*colours_, triangle, face.colours);
  face.is_even = face.is_even && !face.has_colours;
}

void Shader::add_texture(std::uint32_t triangle, const Texture* texture, Face& face) const {
  if (texture == nullptr || places_ == nullptr) return;
  if (!values_of(*places_, triangle, face.texture_places)) return;
  face.texture = texture;
  face.is_even = false;
  const auto& [a, b, c] = face.texture_places;
  const double area = 0.5 * std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
  const auto& [i, j, k] = soup_.triangles[triangle];
  const double pixels = camera_.pixels_of(soup_.points[i], soup_.points[j], soup_.points[k]);
  const double texels = area * static_cast<double>(texture->size().pixels());
  face.copy = texture->copy_for(pixels > 0 ? texels / (pixels * samples_of_pixel_) : 0);
}

double Shader::brightness(std::uint32_t triangle, bool from_behind) const {
  const auto& [a, b, c] = soup_.triangles[triangle];
  const Vec3d normal = camera_.normal(soup_.points[a], soup_.points[b], soup_.points[c]);
  const double side = from_behind ? -1 : 1;
  const double to_lamp =
      side * (normal[0] * kLamp[0] + normal[1] * kLamp[1] + normal[2] * kLamp[2]);
  const double upwards = 0.5 + 0.5 * side * normal[1];
  return kLampLight * std::max(0.0, to_lamp) + kGroundLight + (kSkyLight - kGroundLight) * upwards;
}

Light Shader::light(const Face& face, const std::array<double, 3>& shares) const {
  Light light = face.light;
  if (face.has_colours) {
    const auto& [a, b, c] = face.colours;
    for (std::size_t k = 0; k < 3; ++k) light[k] *= square(mixed(shares, a[k], b[k], c[k]));
  }
  if (face.texture != nullptr) {
    const auto& [a, b, c] = face.texture_places;
    const Light own = face.texture->light(
        mixed(shares, a[0], b[0], c[0]), mixed(shares, a[1], b[1], c[1]), face.copy, face.sampling);
    for (std::size_t k = 0; k < 3; ++k) light[k] *= own[k];
  }
  return light;
}

}  // namespace meshrepair
