// SPDX-License-Identifier: MIT
#include <cerrno>
#include <fcntl.h>
#include <io.h>
#include <new>
#include <sys/stat.h>
#include <windows.h>
// Behind the one that it needs.
#include <ntsecapi.h>

#include <base/internal/system.h>

namespace meshrepair::internal {
namespace {

constexpr int kAlways = _O_BINARY | _O_NOINHERIT;
constexpr std::size_t kMostOfCall = std::size_t{1} << 30;

FileFacts facts_of(const struct _stat64& status) {
  if ((status.st_mode & _S_IFMT) == _S_IFDIR) return {FileKind::folder, 0};
  if ((status.st_mode & _S_IFMT) != _S_IFREG) return {FileKind::other, 0};
  return {FileKind::regular, static_cast<std::uint64_t>(status.st_size)};
}

// The reason of a call of the system, as one of the C library.
int errno_of(DWORD error) {
  switch (error) {
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
      return ENOENT;
    case ERROR_ACCESS_DENIED:
    case ERROR_SHARING_VIOLATION:
    case ERROR_LOCK_VIOLATION:
      return EACCES;
    case ERROR_DISK_FULL:
      return ENOSPC;
    case ERROR_BROKEN_PIPE:
    case ERROR_NO_DATA:
    case ERROR_PIPE_NOT_CONNECTED:
      return EPIPE;
    case ERROR_FILE_EXISTS:
    case ERROR_ALREADY_EXISTS:
      return EEXIST;
    default:
      return EIO;
  }
}

}  // namespace

int open_file(const std::filesystem::path& path, FileUse use) noexcept {
  constexpr int kPermissions = _S_IREAD | _S_IWRITE;
  switch (use) {
    case FileUse::read:
    case FileUse::read_at_once:
      return ::_wopen(path.c_str(), _O_RDONLY | _O_SEQUENTIAL | kAlways);
    case FileUse::write:
      return ::_wopen(path.c_str(), _O_WRONLY | kAlways);
    case FileUse::create:
      return ::_wopen(path.c_str(), _O_WRONLY | _O_CREAT | _O_EXCL | kAlways, kPermissions);
    case FileUse::own:
      return ::_wopen(path.c_str(), _O_WRONLY | _O_CREAT | _O_TRUNC | kAlways, kPermissions);
  }
  return -1;
}

std::ptrdiff_t read_some(int descriptor, char* bytes, std::size_t most) noexcept {
  return ::_read(descriptor, bytes, static_cast<unsigned>(most < kMostOfCall ? most : kMostOfCall));
}

std::ptrdiff_t write_some(int descriptor, const char* bytes, std::size_t most) noexcept {
  const int count =
      ::_write(descriptor, bytes, static_cast<unsigned>(most < kMostOfCall ? most : kMostOfCall));
  // The C library calls all reasons that it does not know wrong arguments.
  if (count < 0 && errno == EINVAL) errno = errno_of(::GetLastError());
  return count;
}

bool close_file(int descriptor) noexcept { return ::_close(descriptor) == 0; }

FileFacts facts_of_file(int descriptor) noexcept {
  struct _stat64 status {};
  return ::_fstat64(descriptor, &status) == 0 ? facts_of(status) : FileFacts();
}

// Not by the C library, which refuses long names.
FileFacts facts_of_file(const std::filesystem::path& path) noexcept {
  WIN32_FILE_ATTRIBUTE_DATA facts = {};
  if (::GetFileAttributesExW(path.c_str(), GetFileExInfoStandard, &facts) == 0) return {};
  if ((facts.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0) return {FileKind::folder, 0};
  if ((facts.dwFileAttributes & FILE_ATTRIBUTE_DEVICE) != 0) return {FileKind::other, 0};
  return {FileKind::regular, (std::uint64_t{facts.nFileSizeHigh} << 32) | facts.nFileSizeLow};
}

// The watchdog ends a program that waits.
bool is_ready(int /*descriptor*/, Direction /*direction*/) noexcept { return true; }

std::size_t most_without_waiting(int /*descriptor*/) noexcept { return std::size_t{1} << 12; }

bool may_write(const std::filesystem::path& path) noexcept {
  const DWORD attributes = ::GetFileAttributesW(path.c_str());
  const bool may =
      attributes == INVALID_FILE_ATTRIBUTES || (attributes & FILE_ATTRIBUTE_READONLY) == 0;
  if (!may) errno = EACCES;
  return may;
}

// Those of the folder are what a new file has.
bool take_permissions(int /*descriptor*/, const std::filesystem::path& /*of*/) noexcept {
  return true;
}

bool flush_to_disk(int descriptor) noexcept { return ::_commit(descriptor) == 0; }

bool rename_file(const std::filesystem::path& from, const std::filesystem::path& to) noexcept {
  constexpr DWORD kHow = MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH;
  if (::MoveFileExW(from.c_str(), to.c_str(), kHow) != 0) return true;
  errno = errno_of(::GetLastError());
  return false;
}

void flush_folder(const std::filesystem::path& /*folder*/) noexcept {}

// By a file in it that is gone with the process.
int hold_folder(const std::filesystem::path& folder) noexcept {
  if (::CreateDirectoryW(folder.c_str(), nullptr) == 0) {
    const DWORD error = ::GetLastError();
    if (facts_of_file(folder).kind != FileKind::folder) {
      errno = error == ERROR_ALREADY_EXISTS ? ENOTDIR : errno_of(error);
      return -1;
    }
  }
  try {
    const HANDLE file =
        ::CreateFileW((folder / L"meshrepair.lock").c_str(), GENERIC_WRITE, 0, nullptr,
                      CREATE_ALWAYS, FILE_ATTRIBUTE_HIDDEN | FILE_FLAG_DELETE_ON_CLOSE, nullptr);
    if (file != INVALID_HANDLE_VALUE) {
      return ::_open_osfhandle(reinterpret_cast<std::intptr_t>(file), _O_NOINHERIT);
    }
    const DWORD error = ::GetLastError();
    errno = error == ERROR_SHARING_VIOLATION ? EWOULDBLOCK : errno_of(error);
  } catch (const std::bad_alloc&) {
    errno = ENOMEM;
  }
  return -1;
}

void release_folder(const std::filesystem::path& folder, int held) noexcept {
  ::_close(held);
  ::RemoveDirectoryW(folder.c_str());
}

// A file that is open stays: who opened it is closed with the process, too late for this.
void remove_file_now(const wchar_t* name) noexcept { ::DeleteFileW(name); }

std::optional<std::uint64_t> random_bits() noexcept {
  std::uint64_t bits = 0;
  if (::RtlGenRandom(&bits, sizeof bits) == FALSE) return std::nullopt;
  return bits;
}

}  // namespace meshrepair::internal
