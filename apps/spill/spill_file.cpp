// SPDX-License-Identifier: MIT
#include "spill/spill_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <iterator>
#include <new>
#include <string>
#include <sys/mman.h>
#include <sys/statvfs.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <base/error.h>
#include <base/internal/system.h>

namespace meshrepair {
namespace {

constexpr std::uint64_t kGrain = std::uint64_t{64} << 10;  // blocks begin and end at multiples
constexpr std::uint64_t kMostAddresses = std::uint64_t{1} << 42;  // that are mapped
constexpr std::uint64_t kLeastAddresses = std::uint64_t{1} << 32;

constexpr double kShareOfDisk = 0.8;

std::uint64_t grains(std::uint64_t bytes) { return (bytes + kGrain - 1) / kGrain * kGrain; }

[[noreturn]] void fail(const std::filesystem::path& folder, int error) {
  throw OutputError("--temp: cannot create a file in " + folder.string() + ": " +
                    std::generic_category().message(error));
}

// A file that no name leads to. Some file systems make such files only by removing their name.
int nameless_file(const std::filesystem::path& folder) {
  const int file = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (file >= 0 || (errno != EOPNOTSUPP && errno != EISDIR)) return file;
  std::string name = (folder / "meshrepair-XXXXXX").string();
  const int named = ::mkostemp(name.data(), O_CLOEXEC);
  if (named >= 0) ::unlink(name.c_str());
  return named;
}

// As many addresses as the system lets a process have; there need be no memory or disk for them.
std::pair<void*, std::uint64_t> mapped(int file) {
  for (std::uint64_t bytes = kMostAddresses; bytes >= kLeastAddresses; bytes /= 2) {
    void* const at =
        ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_NORESERVE, file, 0);
    if (at != MAP_FAILED) return {at, bytes};
  }
  return {nullptr, 0};
}

// Others need some of the disk, too.
std::uint64_t room_for(int file) {
  struct statvfs status = {};
  if (::fstatvfs(file, &status) != 0) return kMostAddresses;
  return static_cast<std::uint64_t>(kShareOfDisk * static_cast<double>(status.f_bavail) *
                                    static_cast<double>(status.f_frsize));
}

}  // namespace

SpillFile::SpillFile(const std::filesystem::path& folder, std::uint64_t most_reserved)
    : descriptor_(nameless_file(folder)), most_reserved_(most_reserved) {
  if (descriptor_ < 0) fail(folder, errno);
  const auto [at, bytes] = mapped(descriptor_);
  if (at == nullptr) {
    const int error = errno;
    ::close(descriptor_);
    fail(folder, error);
  }
  room_ = room_for(descriptor_);
  ::madvise(at, bytes, MADV_DONTDUMP);
  base_ = static_cast<char*>(at);
  addresses_ = bytes;
  set_range(base_, base_ + bytes);
}

SpillFile::~SpillFile() {
  ::munmap(base_, addresses_);
  ::close(descriptor_);
}

void* SpillFile::take(std::size_t bytes) noexcept try {
  if (bytes > addresses_ || internal::process_memory().reserved + bytes <= most_reserved_)
    return nullptr;
  const std::uint64_t size = grains(bytes);
  const std::scoped_lock lock(mutex_);
  const Offset at = place_for(size);
  if (bytes_ + size > room_ || at + size > addresses_ || !reserve(at, size)) {
    add_hole(at, size);
    was_full_ = true;
    return nullptr;
  }
  blocks_.emplace(at, size);
  bytes_ += size;
  most_bytes_ = std::max(most_bytes_.load(), bytes_);
  if (at_first_block_) std::exchange(at_first_block_, {})();
  return base_ + at;
} catch (const std::bad_alloc&) {
  return nullptr;
}

// Its pages are forgotten unwritten. That takes a while for large blocks: others need not wait.
void SpillFile::give_back(void* block) noexcept {
  const Offset at = static_cast<std::uint64_t>(static_cast<char*>(block) - base_);
  const std::uint64_t size = size_of(block);
  int failed = 0;
  do {
    failed = ::fallocate(descriptor_, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE,
                         static_cast<off_t>(at), static_cast<off_t>(size));
  } while (failed != 0 && errno == EINTR);
  const std::scoped_lock lock(mutex_);
  blocks_.erase(at);
  bytes_ -= size;
  try {
    add_hole(at, size);
  } catch (const std::bad_alloc&) {
    // These addresses are not used again.
  }
}

std::size_t SpillFile::size_of(const void* block) const noexcept {
  const Offset at = static_cast<std::uint64_t>(static_cast<const char*>(block) - base_);
  const std::scoped_lock lock(mutex_);
  return blocks_.find(at)->second;
}

void SpillFile::at_first_block(std::function<void()> call) {
  const std::scoped_lock lock(mutex_);
  if (call && extent_ > 0) {
    call();
  } else {
    at_first_block_ = std::move(call);
  }
}

void SpillFile::let_go(std::size_t bytes) noexcept {
  const std::size_t extent = extent_.load();
  std::size_t at = hand_.load();
  if (at >= extent) at = 0;
  const std::size_t size = std::min(bytes, extent - at);
  hand_ = at + size;
  if (size > 0) ::madvise(base_ + at, size, MADV_DONTNEED);
}

SpillFile::Offset SpillFile::place_for(std::uint64_t bytes) {
  auto best = holes_.end();
  for (auto hole = holes_.begin(); hole != holes_.end(); ++hole) {
    if (hole->second >= bytes && (best == holes_.end() || hole->second < best->second)) best = hole;
  }
  if (best == holes_.end()) return extent_.fetch_add(bytes);
  const auto [at, size] = *best;
  holes_.erase(best);
  if (size > bytes) holes_.emplace(at + bytes, size - bytes);
  return at;
}

// Joined with what is free on either side.
void SpillFile::add_hole(Offset at, std::uint64_t bytes) {
  auto next = holes_.lower_bound(at);
  if (next != holes_.begin()) {
    const auto before = std::prev(next);
    if (before->first + before->second == at) {
      at = before->first;
      bytes += before->second;
      holes_.erase(before);
    }
  }
  if (next != holes_.end() && at + bytes == next->first) {
    bytes += next->second;
    next = holes_.erase(next);
  }
  if (at + bytes == extent_.load()) {
    extent_ = at;
  } else {
    holes_.emplace_hint(next, at, bytes);
  }
}

// A page for which the disk has no room would kill the process when it is written.
bool SpillFile::reserve(Offset at, std::uint64_t bytes) noexcept {
  const int file = descriptor_;
  int failed = 0;
  do {
    failed = ::fallocate(file, 0, static_cast<off_t>(at), static_cast<off_t>(bytes));
  } while (failed != 0 && errno == EINTR);
  if (failed == 0) return true;
  if (errno != EOPNOTSUPP) return false;
  return ::posix_fallocate(file, static_cast<off_t>(at), static_cast<off_t>(bytes)) == 0;
}

}  // namespace meshrepair
