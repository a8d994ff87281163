// SPDX-License-Identifier: MIT
// Whether a file is still what it was.
#pragma once

#include <cstdint>
#include <filesystem>

namespace meshrepair {

// Of its bytes and how many they are. Throws InputError where it cannot be read.
[[nodiscard]] std::uint64_t file_checksum(const std::filesystem::path& file);

// Of the program that runs. Throws ValueError where the system does not tell which file that is.
[[nodiscard]] std::uint64_t program_checksum();

}  // namespace meshrepair
