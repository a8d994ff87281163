#include "page/page_pictures.h"

#include <algorithm>
#include <cstdint>
#include <string_view>

#include <base/base64.h>
#include <base/error.h>
#include <picture/image_bytes.h>

#include "common/numbers.h"

namespace meshrepair {
namespace {

// Of one picture: more is not worth to be read.
constexpr std::uintmax_t kMostFileBytes = std::uintmax_t{1} << 28;

bool is_known_kind(std::string_view bytes) {
  return bytes.starts_with("\x89PNG\r\n\x1a\n") || bytes.starts_with("\xFF\xD8\xFF");
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
  if (!is_known_kind(place->first)) {
    leave_out(image, "is neither PNG nor JPEG");
  } else if (place->first.size() > kMostBytes - bytes_) {
    leave_out(image, "would make the page too large: all pictures together may have 8 MiB");
  } else {
    bytes_ += place->first.size();
    place->second = texts_.size();
    texts_.push_back(encode_base64(place->first));
  }
  return place->second;
}

void PagePictures::leave_out(const Image& image, const std::string& why) {
  const Json line =
      (image.name.empty() ? "A picture" : "The picture '" + image.name + "'") + " " + why;
  if (std::find(left_out_.begin(), left_out_.end(), line) == left_out_.end())
    left_out_.push_back(line);
}

}  // namespace meshrepair
