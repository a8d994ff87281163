// SPDX-License-Identifier: MIT
// The file of one state: a key, the bytes, and a checksum of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>

namespace meshrepair {

// Nothing where there is no such file.
[[nodiscard]] std::optional<std::uint64_t> key_of_state(const std::filesystem::path& file);

// Puts what `write` writes on the disk. Throws std::filesystem::filesystem_error.
void write_state(const std::filesystem::path& file, std::uint64_t key,
                 const std::function<void(std::ostream&)>& write);

// Lets `read` read the bytes, of which there are so many; what it leaves is read, too. Whether all
// could be read, and are those that were written.
[[nodiscard]] bool read_state(const std::filesystem::path& file,
                              const std::function<void(std::istream&, std::uint64_t)>& read);

}  // namespace meshrepair
