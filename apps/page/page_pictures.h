// SPDX-License-Identifier: MIT
// The pictures that a page embeds, as they are in their files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <mesh/attributes.h>

namespace meshrepair {

class PagePictures {
 public:
  // Of all together, before they become text.
  static constexpr std::size_t kMostBytes = std::size_t{8} << 20;

  // Opens files only within the folders of these meshes.
  explicit PagePictures(const std::vector<std::string>& mesh_files);

  // Of the picture in the page; nothing where it is no PNG or JPEG, is broken or too large, or
  // cannot be had: then it is among those left out. Each is embedded once.
  [[nodiscard]] std::optional<std::size_t> number_of(const Image& image);

  // In base64, by number.
  [[nodiscard]] const std::vector<std::string>& texts() const { return texts_; }
  // What is left out, and why: a sentence for each.
  [[nodiscard]] const std::vector<std::string>& left_out() const { return left_out_; }

 private:
  void leave_out(const Image& image, const std::string& why);

  std::vector<std::filesystem::path> folders_;
  std::map<std::string, std::optional<std::size_t>> known_;  // by their bytes
  std::vector<std::string> texts_;
  std::vector<std::string> left_out_;
  std::size_t bytes_ = 0;
};

}  // namespace meshrepair
