// SPDX-License-Identifier: MIT
#include <cstdint>
#include <utility>

#include <base/error.h>
#include <base/ids.h>
#include <mesh/mesh_source.h>
#include <picture/decode_image.h>
#include <picture/textures.h>

namespace meshrepair {
namespace {

namespace fs = std::filesystem;

// Of a file beside the mesh. More is no picture of so many pixels.
constexpr std::uintmax_t kMostFileBytes = std::uintmax_t{1} << 28;

std::vector<char> needed_images(const Attributes& attributes) {
  std::vector<char> needed(attributes.images.size(), 0);
  if (find_kind(attributes, CornerAttribute::Kind::texture) == nullptr) return needed;
  for (const std::uint32_t material : attributes.materials.of_triangle) {
    if (material >= attributes.looks.size()) continue;
    const std::uint32_t image = attributes.looks[material].image;
    if (image < needed.size()) needed[image] = 1;
  }
  return needed;
}

std::string name_of(const Image& image) {
  if (!image.name.empty()) return "the picture '" + printable(image.name) + "'";
  return "a picture";
}

}  // namespace

Textures::Textures(std::vector<fs::path> folders) : folders_(std::move(folders)) {}

std::vector<std::shared_ptr<const Texture>> Textures::of(const Attributes& attributes) {
  const std::vector<char> needed = needed_images(attributes);
  std::vector<std::shared_ptr<const Texture>> textures(needed.size());
  for (std::size_t i = 0; i < needed.size(); ++i) {
    if (needed[i] != 0) textures[i] = get(attributes.images[i]);
  }
  return textures;
}

std::shared_ptr<const Texture> Textures::get(const Image& image) {
  const auto [place, is_new] = known_.try_emplace({image.bytes, image.bytes ? "" : image.path});
  if (!is_new) return place->second;
  try {
    Pixels pixels = pixels_of(image);
    pixels_ += pixels.size.pixels();
    place->second = std::make_shared<const Texture>(std::move(pixels));
  } catch (const InputError& error) {
    warnings_.push_back(
        {WarningCode::picture_unreadable, name_of(image) + " " + error.what() + "; not drawn"});
  }
  return place->second;
}

Pixels Textures::pixels_of(const Image& image) const {
  const std::size_t most = kMostImagePixels - pixels_;
  if (image.bytes) return decode_image(*image.bytes, most);
  return decode_image(image_bytes(image, folders_, kMostFileBytes), most);
}

}  // namespace meshrepair
