// SPDX-License-Identifier: MIT
#include <cerrno>
#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/stat.h>
#if __has_include(<sys/random.h>)
#include <sys/random.h>
#endif
#include <unistd.h>

#include <climits>

#include <base/internal/system.h>

namespace meshrepair::internal {
namespace {

FileFacts facts_of(const struct stat& status) {
  if (S_ISDIR(status.st_mode)) return {FileKind::folder, 0};
  if (!S_ISREG(status.st_mode)) return {FileKind::other, 0};
  return {FileKind::regular, static_cast<std::uint64_t>(status.st_size)};
}

// The process that had the lock may have removed the folder with it.
bool is_still_there(int descriptor, const std::filesystem::path& folder) {
  struct stat opened {
  }, named{};
  return ::fstat(descriptor, &opened) == 0 && ::stat(folder.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

}  // namespace

// What is opened at once is waited for later as ever.
int open_file(const std::filesystem::path& path, FileUse use) noexcept {
  constexpr mode_t kAllowed = 0666;
  switch (use) {
    case FileUse::read:
      return ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    case FileUse::read_at_once: {
      const int number = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
      if (number >= 0) ::fcntl(number, F_SETFL, ::fcntl(number, F_GETFL) & ~O_NONBLOCK);
      return number;
    }
    case FileUse::write:
      return ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    case FileUse::create:
      return ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kAllowed);
    case FileUse::own:
      return ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, S_IRUSR | S_IWUSR);
  }
  return -1;
}

std::ptrdiff_t read_some(int descriptor, char* bytes, std::size_t most) noexcept {
  return ::read(descriptor, bytes, most);
}

std::ptrdiff_t write_some(int descriptor, const char* bytes, std::size_t most) noexcept {
  return ::write(descriptor, bytes, most);
}

bool close_file(int descriptor) noexcept { return ::close(descriptor) == 0; }

FileFacts facts_of_file(int descriptor) noexcept {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 ? facts_of(status) : FileFacts();
}

FileFacts facts_of_file(const std::filesystem::path& path) noexcept {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 ? facts_of(status) : FileFacts();
}

bool is_ready(int descriptor, Direction direction) noexcept {
  constexpr int kMilliseconds = 100;
  pollfd waiting = {descriptor, static_cast<short>(direction == Direction::in ? POLLIN : POLLOUT),
                    0};
  const int ready = ::poll(&waiting, 1, kMilliseconds);
  return ready > 0 || (ready < 0 && errno != EINTR);
}

std::size_t most_without_waiting(int /*descriptor*/) noexcept { return PIPE_BUF; }

bool may_write(const std::filesystem::path& path) noexcept {
  return ::access(path.c_str(), W_OK) == 0;
}

bool take_permissions(int descriptor, const std::filesystem::path& of) noexcept {
  struct stat old {};
  if (::stat(of.c_str(), &old) != 0) return false;
  if (::fchown(descriptor, old.st_uid, old.st_gid) != 0) errno = 0;
  return ::fchmod(descriptor, old.st_mode & 07777) == 0;
}

bool flush_to_disk(int descriptor) noexcept { return ::fsync(descriptor) == 0; }

bool rename_file(const std::filesystem::path& from, const std::filesystem::path& to) noexcept {
  return ::rename(from.c_str(), to.c_str()) == 0;
}

void flush_folder(const std::filesystem::path& folder) noexcept {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

int hold_folder(const std::filesystem::path& folder) noexcept {
  for (;;) {
    ::mkdir(folder.c_str(), S_IRWXU);  // or it is there
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return -1;
    const bool is_locked = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
    const int error = errno;
    if (is_locked && is_still_there(descriptor, folder)) return descriptor;
    ::close(descriptor);
    if (is_locked) continue;
    errno = error;
    return -1;
  }
}

void release_folder(const std::filesystem::path& folder, int held) noexcept {
  ::rmdir(folder.c_str());
  ::close(held);
}

void remove_file_now(const char* name) noexcept { ::unlink(name); }

std::size_t longest_path() noexcept { return PATH_MAX; }

// Not by std::random_device, which asks the processor what it can: a virtual one takes long.
std::optional<std::uint64_t> random_bits() noexcept {
  std::uint64_t bits = 0;
  if (::getentropy(&bits, sizeof bits) != 0) return std::nullopt;
  return bits;
}

}  // namespace meshrepair::internal
