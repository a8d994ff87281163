// The bytes of pictures that meshes name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include <mesh/attributes.h>

namespace meshrepair {

// As they are; nobody looks into them. Files are opened only within these folders. Throws
// InputError, a part of a sentence, where the picture is not there or has more bytes than `most`.
[[nodiscard]] std::string image_bytes(const Image& image,
                                      std::span<const std::filesystem::path> folders,
                                      std::uintmax_t most);

}  // namespace meshrepair
