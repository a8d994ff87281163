// The bytes of an input file, without copying them where possible.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace meshrepair {

// A regular file is mapped into memory; standard input ("-"), pipes and devices are read to their
// end. Throws InputError, naming the path and the system's reason. A mapped file must not be
// shortened by others while it is being read.
class MappedFile {
 public:
  explicit MappedFile(const std::filesystem::path& path);
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();

  [[nodiscard]] std::string_view bytes() const {
    return map_ != nullptr ? std::string_view(static_cast<const char*>(map_), map_size_) : copy_;
  }

 private:
  void* map_ = nullptr;
  std::size_t map_size_ = 0;
  std::string copy_;
};

}  // namespace meshrepair
