// SPDX-License-Identifier: MIT
// A folder for this process alone, which stays the same one whatever becomes of its name.
//
// The folder that lies above it, /tmp, belongs to all users. Somebody may clear it, and somebody
// else may make a folder of the same name. So the folder is held open, and all in it is reached
// from there; its name is only for those who have nothing else, as systems other than Linux.
#pragma once

#include <filesystem>
#include <string>

namespace meshrepair {

class OwnFolder {
 public:
  // Makes one in $TMPDIR or /tmp that only this user can read. Throws OutputError.
  explicit OwnFolder(const std::string& name);
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;
  // Removes it with all that is in it.
  ~OwnFolder();

  // Leads to the folder, on Linux by its descriptor, in this process. Once the folder is removed,
  // nothing can be made in it.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  // For a process that is to work in it.
  [[nodiscard]] int descriptor() const { return descriptor_; }
  // Where it lies, or lay.
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  [[nodiscard]] bool is_named_so() const;

  std::string name_;
  int descriptor_ = -1;
  std::filesystem::path path_;
};

// The descriptor of a file that is read; -1 where there is none, or where it is a link, a folder,
// or no file at all.
[[nodiscard]] int open_plain_file(const std::filesystem::path& path);

}  // namespace meshrepair
