// SPDX-License-Identifier: MIT
// What light comes from a place of a triangle.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <mesh/attributes.h>
#include <mesh/soup.h>
#include <picture/camera.h>
#include <picture/texture.h>

namespace meshrepair {

// Not owned: the soup, its attributes and the camera outlive it.
class Shader {
 public:
  struct Options {
    unsigned samples = 1;     // along each side of a pixel
    bool both_sides = false;  // what is seen from behind has its own colours
  };
  // A texture for each picture of the attributes, or null.
  Shader(const TriangleSoup& soup, const Attributes& attributes,
         std::vector<std::shared_ptr<const Texture>> textures, const Camera& camera,
         const Options& options);

  // What all places of a triangle have in common.
  struct Face {
    Light light = {0, 0, 0};
    bool is_even = true;  // all of it has this light
    bool has_colours = false;
    std::array<std::array<double, 3>, 3> colours{};  // of the corners
    const Texture* texture = nullptr;
    std::size_t copy = 0;  // of the texture
    TextureSampling sampling;
    std::array<std::array<double, 2>, 3> texture_places{};
  };
  [[nodiscard]] Face face(std::uint32_t triangle, bool from_behind) const;

  // Where the corners have these shares.
  [[nodiscard]] Light light(const Face& face, const std::array<double, 3>& shares) const;

 private:
  void add_look(std::uint32_t triangle, Face& face) const;
  void add_texture(std::uint32_t triangle, const Texture* texture, Face& face) const;
  void add_colours(std::uint32_t triangle, Face& face) const;
  [[nodiscard]] double brightness(std::uint32_t triangle, bool from_behind) const;

  const TriangleSoup& soup_;
  const Attributes& attributes_;
  std::vector<std::shared_ptr<const Texture>> textures_;
  const Camera& camera_;
  double samples_of_pixel_;
  bool both_sides_;
  const CornerAttribute* places_;   // in textures; null: none
  const CornerAttribute* colours_;  // null: none
};

}  // namespace meshrepair
