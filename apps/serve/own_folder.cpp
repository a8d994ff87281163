// SPDX-License-Identifier: MIT
#include "serve/own_folder.h"

#include <cstdlib>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <vector>

#include <base/error.h>
#include <base/internal/processes.h>

namespace meshrepair {
namespace {

namespace fs = std::filesystem;

std::string made_folder(const std::string& start) {
  const char* given = std::getenv("TMPDIR");  // NOLINT(concurrency-mt-unsafe): never changed
  std::string name =
      std::string(given != nullptr && *given != '\0' ? given : "/tmp") + "/" + start + "-XXXXXX";
  if (::mkdtemp(name.data()) == nullptr) {
    throw OutputError(name + ": the folder cannot be created");
  }
  return name;
}

void remove_all_in(const fs::path& folder) {
  std::error_code none;
  std::vector<fs::path> inside;
  for (fs::directory_iterator at(folder, none); !none && at != fs::directory_iterator();
       at.increment(none)) {
    inside.push_back(at->path());
  }
  for (const fs::path& path : inside) fs::remove_all(path, none);
}

bool is_same(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

}  // namespace

OwnFolder::OwnFolder(const std::string& name) : name_(made_folder(name)) {
  descriptor_ = ::open(name_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  struct stat found = {};
  const bool is_ours = descriptor_ >= 0 && ::fstat(descriptor_, &found) == 0 &&
                       found.st_uid == ::geteuid() && (found.st_mode & 0077) == 0;
  if (!is_ours) {
    if (descriptor_ >= 0) ::close(descriptor_);
    throw OutputError(name_ + ": is not the folder that was created");
  }
  path_ = internal::path_of_folder(descriptor_, name_);
}

// Where the path is only a name, it may be that of another folder by now.
OwnFolder::~OwnFolder() {
  const bool is_there = is_named_so();
  if (is_there || path_ != name_) remove_all_in(path_);
  if (is_there) ::rmdir(name_.c_str());
  ::close(descriptor_);
}

bool OwnFolder::is_named_so() const {
  struct stat named = {};
  struct stat held = {};
  return ::lstat(name_.c_str(), &named) == 0 && ::fstat(descriptor_, &held) == 0 &&
         is_same(named, held);
}

// O_NONBLOCK: a pipe would wait for somebody who writes to it.
int open_plain_file(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  struct stat found = {};
  if (file < 0 || (::fstat(file, &found) == 0 && S_ISREG(found.st_mode))) return file;
  ::close(file);
  return -1;
}

}  // namespace meshrepair
