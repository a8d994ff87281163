// SPDX-License-Identifier: MIT
#include <algorithm>
#include <system_error>

#include <base/error.h>
#include <base/file_bytes.h>
#include <mesh/mesh_source.h>
#include <mesh/named_files.h>
#include <picture/decode_image.h>

#include "image_readers.h"

namespace meshrepair {

Pixels decode_image(std::string_view bytes, std::size_t most_pixels) {
  if (begins_with_png(bytes)) return read_png(bytes, most_pixels);
  if (begins_with_jpeg(bytes)) return read_jpeg(bytes, most_pixels);
  throw InputError("is neither PNG nor JPEG");
}

namespace fs = std::filesystem;

std::string image_bytes(const Image& image, std::span<const fs::path> folders,
                        std::uintmax_t most) {
  if (image.bytes) {
    if (image.bytes->size() > most) throw InputError("is too large");
    return *image.bytes;
  }
  const fs::path path = image.path;
  const bool is_allowed = std::any_of(folders.begin(), folders.end(), [&](const fs::path& folder) {
    return is_file_within(folder, path);
  });
  if (!is_allowed) throw InputError("is not there, or not in the mesh's folder");
  std::error_code error;
  if (const auto size = fs::file_size(path, error); error || size > most) {
    throw InputError("is too large");
  }
  return std::string(FileBytes(path).bytes());
}

}  // namespace meshrepair
