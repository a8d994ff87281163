// SPDX-License-Identifier: MIT
// The pictures that the materials of a mesh have.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <base/warning.h>
#include <mesh/attributes.h>
#include <picture/texture.h>

namespace meshrepair {

// Opens files only within some folders, and each picture once, so that several drawings share it.
class Textures {
 public:
  // Those of the files that meshes were read from. Without any, only pictures that are part of a
  // mesh's file are there.
  explicit Textures(std::vector<std::filesystem::path> folders = {});

  // Of each picture of the attributes; null where no triangle needs it, or it cannot be had.
  [[nodiscard]] std::vector<std::shared_ptr<const Texture>> of(const Attributes& attributes);

  // A sentence for each picture that could not be had.
  [[nodiscard]] const std::vector<Warning>& warnings() const { return warnings_; }

 private:
  [[nodiscard]] std::shared_ptr<const Texture> get(const Image& image);
  [[nodiscard]] Pixels pixels_of(const Image& image) const;

  // Bytes, or the name of a file. The bytes are kept: no others are where they were.
  using Key = std::pair<std::shared_ptr<const std::string>, std::string>;

  std::vector<std::filesystem::path> folders_;
  std::map<Key, std::shared_ptr<const Texture>> known_;
  std::vector<Warning> warnings_;
  std::size_t pixels_ = 0;  // of all
};

}  // namespace meshrepair
