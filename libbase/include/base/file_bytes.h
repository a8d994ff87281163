// SPDX-License-Identifier: MIT
// The bytes of an input file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include <base/block_source.h>
#include <base/progress.h>

namespace meshrepair {

// Reads a file, standard input ("-"), a pipe or a device to its end. Copied, not mapped: whoever
// shortens a mapped file kills the process that reads it. `progress` may be null; it is asked while
// bytes are waited for whether to go on. Throws InputError, naming the path and the system's
// reason.
class FileBytes {
 public:
  explicit FileBytes(const std::filesystem::path& path, ProgressObserver* progress = nullptr);

  [[nodiscard]] std::string_view bytes() const { return {buffer_.get(), size_}; }

 private:
  struct Free {
    void operator()(char* bytes) const { free_block(bytes); }
  };

  void reserve(std::size_t capacity);
  void read_to_end(int descriptor, const std::string& name, ProgressObserver* progress);

  std::unique_ptr<char, Free> buffer_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace meshrepair
