// SPDX-License-Identifier: MIT
// Files that belong together.
#pragma once

#include <filesystem>
#include <string>

namespace meshrepair {

struct BundledFile {
  std::filesystem::path path;
  std::string bytes;
};

}  // namespace meshrepair
