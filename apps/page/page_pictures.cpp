// SPDX-License-Identifier: MIT
#include "page/page_pictures.h"

#include <algorithm>
#include <cstdint>

#include <base/base64.h>
#include <base/error.h>
#include <picture/decode_image.h>

namespace meshrepair {
namespace {

// Of one picture: more is not worth to be read.
constexpr std::uintmax_t kMostFileBytes = std::uintmax_t{1} << 28;

// Of one picture: a browser unpacks them all.
constexpr std::size_t kMostPixels = std::size_t{1} << 24;

// Why a browser should not get these bytes, as a part of a sentence; empty: it may.
std::string why_not(const std::string& bytes, std::size_t room) {
  if (bytes.size() > room) {
    return "would make the page too large: all pictures together may have 8 MiB";
  }
  try {
    (void)decode_image(bytes, kMostPixels);
    return {};
  } catch (const InputError& error) {
    return error.what();
  }
}

}  // namespace

PagePictures::PagePictures(const std::vector<std::string>& mesh_files) {
  for (const std::string& file : mesh_files) {
    if (file != "-") folders_.push_back(std::filesystem::path(file).parent_path());
  }
}

std::optional<std::size_t> PagePictures::number_of(const Image& image) {
  std::string bytes;
  try {
    bytes = image_bytes(image, folders_, kMostFileBytes);
  } catch (const InputError& error) {
    leave_out(image, error.what());
    return std::nullopt;
  }
  const auto [place, is_new] = known_.try_emplace(std::move(bytes));
  if (!is_new) return place->second;
  const std::string why = why_not(place->first, kMostBytes - bytes_);
  if (why.empty()) {
    bytes_ += place->first.size();
    place->second = texts_.size();
    texts_.push_back(encode_base64(place->first));
  } else {
    leave_out(image, why);
  }
  return place->second;
}

void PagePictures::leave_out(const Image& image, const std::string& why) {
  const std::string line =
      (image.name.empty() ? "A picture" : "The picture '" + image.name + "'") + " " + why;
  if (std::find(left_out_.begin(), left_out_.end(), line) == left_out_.end())
    left_out_.push_back(line);
}

}  // namespace meshrepair
