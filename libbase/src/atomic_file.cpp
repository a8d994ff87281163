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
#include <mutex>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <base/atomic_file.h>
#include <base/error.h>
#include <base/internal/system.h>

#include "wait_for_descriptor.h"

namespace meshrepair {
namespace {

namespace fs = std::filesystem;

using internal::FileKind, internal::FileUse;
using Letter = fs::path::value_type;

// The name of the unfinished file; null if there is none. Read by signal handlers and from other
// threads, so that it lives in a place that is never freed.
std::atomic<const Letter*> unfinished_name = nullptr;
static_assert(std::atomic<const Letter*>::is_always_lock_free);

void register_unfinished(const fs::path& name) {
  static std::vector<Letter>& buffer = *new std::vector<Letter>(internal::longest_path() + 1);
  const auto& letters = name.native();
  if (letters.size() >= buffer.size()) return;  // no system makes such a file
  std::copy_n(letters.c_str(), letters.size() + 1, buffer.begin());
  unfinished_name.store(buffer.data());
}

std::mutex one_at_a_time;

[[noreturn]] void fail(const fs::path& path, const std::string& what, int error) {
  throw OutputError(path.string() + ": " + what + ": " + std::generic_category().message(error));
}

std::size_t bytes_at_once(int descriptor) {
  constexpr std::size_t kFileBytes = std::size_t{1} << 20;
  const bool is_file = internal::facts_of_file(descriptor).kind == FileKind::regular;
  return is_file ? kFileBytes : internal::most_without_waiting(descriptor);
}

void write_all(int descriptor, std::string_view bytes, const fs::path& path,
               ProgressObserver* progress) {
  const std::size_t most = progress != nullptr ? bytes_at_once(descriptor) : bytes.size();
  while (!bytes.empty()) {
    if (progress != nullptr) {
      wait_for_descriptor(descriptor, internal::Direction::out, *progress);
    }
    const std::ptrdiff_t count =
        internal::write_some(descriptor, bytes.data(), std::min(most, bytes.size()));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(path, "cannot be written", errno);
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

void write_directly(const fs::path& path, std::string_view bytes, ProgressObserver* progress) {
  const int descriptor = internal::open_file(path, FileUse::write);
  if (descriptor < 0) fail(path, "cannot be opened for writing", errno);
  try {
    write_all(descriptor, bytes, path, progress);
  } catch (...) {
    internal::close_file(descriptor);
    throw;
  }
  if (!internal::close_file(descriptor)) fail(path, "cannot be written", errno);
}

// "FOLDER/.NAME.RANDOM.tmp", the name shortened to what file systems take.
fs::path temporary_name(const fs::path& target) {
  constexpr std::size_t kLongest = 200;
  const auto random = internal::random_bits();
  if (!random) fail(target, "no random name", errno);
  std::array<char, 24> suffix;
  std::snprintf(suffix.data(), suffix.size(), ".%016llx.tmp",
                static_cast<unsigned long long>(*random));
  fs::path name = ".";
  name += target.filename().native().substr(0, kLongest);
  name += suffix.data();
  return target.parent_path() / name;
}

// The unfinished file. Removed on destruction unless it became the target.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& target) : target_(target), name_(temporary_name(target)) {
    register_unfinished(name_);
    descriptor_ = internal::open_file(name_, FileUse::create);
    if (descriptor_ < 0) {
      const int error = errno;
      unfinished_name.store(nullptr);
      fail(target_, "cannot be written", error);
    }
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (descriptor_ >= 0) internal::close_file(descriptor_);
    if (!renamed_) internal::remove_file_now(name_.c_str());
    unfinished_name.store(nullptr);
  }

  // Keeps what it may keep of the owner, and the permissions.
  void take_permissions(const fs::path& old) {
    if (!internal::take_permissions(descriptor_, old)) fail(target_, "cannot be written", errno);
  }

  void write(std::string_view bytes, ProgressObserver* progress) {
    write_all(descriptor_, bytes, target_, progress);
  }

  void become_target() {
    if (!internal::flush_to_disk(descriptor_)) fail(target_, "cannot be written", errno);
    const bool is_closed = internal::close_file(std::exchange(descriptor_, -1));
    if (!is_closed) fail(target_, "cannot be written", errno);
    if (!internal::rename_file(name_, target_)) fail(target_, "cannot be replaced", errno);
    renamed_ = true;
  }

 private:
  fs::path target_;
  fs::path name_;
  int descriptor_ = -1;
  bool renamed_ = false;
};

void replace_file(const fs::path& path, std::string_view bytes, bool exists,
                  ProgressObserver* progress) {
  const std::lock_guard lock(one_at_a_time);
  const fs::path target = follow_links(path);
  // A rename would replace a file that is protected against writing.
  if (exists && !internal::may_write(target)) fail(path, "cannot be written", errno);
  TemporaryFile file(target);
  if (exists) file.take_permissions(target);
  file.write(bytes, progress);
  file.become_target();
  internal::flush_folder(target.has_parent_path() ? target.parent_path() : fs::path("."));
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
  if (path == "-") return write_all(internal::kStandardOutput, bytes, "standard output", progress);
  const FileKind kind = internal::facts_of_file(path).kind;
  if (kind == FileKind::folder) throw OutputError(path.string() + ": is a folder");
  if (kind == FileKind::other) return write_directly(path, bytes, progress);
  replace_file(path, bytes, kind == FileKind::regular, progress);
}

void remove_unfinished_file() noexcept {
  const Letter* const name = unfinished_name.load();
  if (name != nullptr) internal::remove_file_now(name);
}

}  // namespace meshrepair
