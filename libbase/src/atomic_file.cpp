// SPDX-License-Identifier: MIT
// The steps: a temporary file with a random name in the folder of the target, all bytes, fsync,
// rename, fsync of the folder. The name is registered before the file is made and forgotten after
// it is gone, so that a signal handler finds it at any time in between; one file is written at a
// time for that reason.
#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <fcntl.h>
#include <mutex>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <climits>

#include <base/atomic_file.h>
#include <base/error.h>

#include "wait_for_descriptor.h"

namespace meshrepair {
namespace {

namespace fs = std::filesystem;

// The name of the unfinished file; null if there is none. Read by signal handlers and from other
// threads, so that it lives in a place that is never freed.
std::atomic<const char*> unfinished_name = nullptr;
static_assert(std::atomic<const char*>::is_always_lock_free);
std::array<char, PATH_MAX + 1> unfinished_buffer;

void register_unfinished(const std::string& name) {
  if (name.size() >= unfinished_buffer.size()) return;  // no system makes such a file
  std::copy_n(name.c_str(), name.size() + 1, unfinished_buffer.begin());
  unfinished_name.store(unfinished_buffer.data());
}

std::mutex one_at_a_time;

[[noreturn]] void fail(const fs::path& path, const std::string& what, int error) {
  throw OutputError(path.string() + ": " + what + ": " + std::generic_category().message(error));
}

// What can be written without blocking once the descriptor is writable: a pipe has room for
// PIPE_BUF bytes then.
std::size_t bytes_at_once(int descriptor) {
  constexpr std::size_t kFileBytes = std::size_t{1} << 20;
  struct stat status {};
  const bool is_file = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  return is_file ? kFileBytes : PIPE_BUF;
}

void write_all(int descriptor, std::string_view bytes, const fs::path& path,
               ProgressObserver* progress) {
  const std::size_t most = progress != nullptr ? bytes_at_once(descriptor) : bytes.size();
  while (!bytes.empty()) {
    if (progress != nullptr) wait_for_descriptor(descriptor, POLLOUT, *progress);
    const ssize_t count = ::write(descriptor, bytes.data(), std::min(most, bytes.size()));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(path, "cannot be written", errno);
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

void write_directly(const fs::path& path, std::string_view bytes, ProgressObserver* progress) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) fail(path, "cannot be opened for writing", errno);
  try {
    write_all(descriptor, bytes, path, progress);
  } catch (...) {
    ::close(descriptor);
    throw;
  }
  if (::close(descriptor) != 0) fail(path, "cannot be written", errno);
}

// "FOLDER/.NAME.RANDOM.tmp", the name shortened to what file systems take.
std::string temporary_name(const fs::path& target) {
  constexpr std::size_t kLongest = 200;
  // Not by std::random_device, which asks the processor what it can: a virtual one takes long.
  std::uint64_t random = 0;
  if (::getentropy(&random, sizeof random) != 0) fail(target, "no random name", errno);
  std::array<char, 24> suffix;
  std::snprintf(suffix.data(), suffix.size(), ".%016llx.tmp",
                static_cast<unsigned long long>(random));
  const std::string name = target.filename().string().substr(0, kLongest);
  return (target.parent_path() / ("." + name + suffix.data())).string();
}

// The unfinished file. Removed on destruction unless it became the target.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& target) : target_(target), name_(temporary_name(target)) {
    register_unfinished(name_);
    descriptor_ = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0) {
      const int error = errno;
      unfinished_name.store(nullptr);
      fail(target_, "cannot be written", error);
    }
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!renamed_) ::unlink(name_.c_str());
    unfinished_name.store(nullptr);
  }

  // Keeps what it may keep of the owner, and the permissions.
  void take_permissions(const struct stat& old) {
    if (::fchown(descriptor_, old.st_uid, old.st_gid) != 0) errno = 0;
    if (::fchmod(descriptor_, old.st_mode & 07777) != 0) fail(target_, "cannot be written", errno);
  }

  void write(std::string_view bytes, ProgressObserver* progress) {
    write_all(descriptor_, bytes, target_, progress);
  }

  void become_target() {
    if (::fsync(descriptor_) != 0) fail(target_, "cannot be written", errno);
    const int closed = ::close(std::exchange(descriptor_, -1));
    if (closed != 0) fail(target_, "cannot be written", errno);
    if (::rename(name_.c_str(), target_.c_str()) != 0) fail(target_, "cannot be replaced", errno);
    renamed_ = true;
  }

 private:
  fs::path target_;
  std::string name_;
  int descriptor_ = -1;
  bool renamed_ = false;
};

// Makes the rename last through a power failure. Some file systems cannot; the file is whole all
// the same.
void sync_folder(const fs::path& target) {
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

void replace_file(const fs::path& path, std::string_view bytes, const struct stat* old,
                  ProgressObserver* progress) {
  const std::lock_guard lock(one_at_a_time);
  const fs::path target = follow_links(path);
  // A rename would replace a file that is protected against writing.
  if (old != nullptr && ::access(target.c_str(), W_OK) != 0) fail(path, "cannot be written", errno);
  TemporaryFile file(target);
  if (old != nullptr) file.take_permissions(*old);
  file.write(bytes, progress);
  file.become_target();
  sync_folder(target);
}

}  // namespace

fs::path follow_links(const fs::path& path) {
  constexpr int kMostLinks = 40;  // as the system has it
  fs::path place = path;
  std::error_code error;
  for (int i = 0; i < kMostLinks && fs::is_symlink(place, error); ++i) {
    place = place.parent_path() / fs::read_symlink(place, error);
  }
  return place;
}

void write_file_atomically(const fs::path& path, std::string_view bytes,
                           ProgressObserver* progress) {
  if (path == "-") return write_all(STDOUT_FILENO, bytes, "standard output", progress);
  struct stat status {};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) throw OutputError(path.string() + ": is a folder");
  if (exists && !S_ISREG(status.st_mode)) return write_directly(path, bytes, progress);
  replace_file(path, bytes, exists ? &status : nullptr, progress);
}

void remove_unfinished_file() noexcept {
  const char* const name = unfinished_name.load();
  if (name != nullptr) ::unlink(name);
}

}  // namespace meshrepair
