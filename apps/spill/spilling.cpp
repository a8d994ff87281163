// SPDX-License-Identifier: MIT
#include "spill/spilling.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <linux/magic.h>
#include <sys/vfs.h>

#include <spdlog/logger.h>

#include <base/block_source.h>
#include <base/error.h>

#include "spill/resident_limit.h"
#include "spill/spill_file.h"
#include "terminal/logging.h"

namespace meshrepair {
namespace {

constexpr const char* kDefaultFolder = "/var/tmp";  // for large files, which /tmp may not be

// Of the limit: what is allocated before is the system's. Who names a size has less than is needed,
// and pages of the file take turns in what is left; the whole machine is seldom too small.
constexpr std::uint64_t kInMemory = 4, kInMemoryOfShare = 2;

std::string default_folder() {
  const char* const named = std::getenv("TMPDIR");
  return named != nullptr && *named != '\0' ? named : kDefaultFolder;
}

// Bytes: what the file itself keeps of its blocks is smaller, and cannot lie in it.
constexpr std::size_t kLeastForced = 1024;
// Then all of it is let go of at each tick. What follows has to come back, or nothing else is done.
constexpr std::chrono::milliseconds kTickWhenForced{5};

// For tests: blocks from this size on lie in the file, whatever the limit, and none of them stays
// in memory. 0: as the limit says.
std::size_t forced_block() {
  const char* const named = std::getenv("MESHREPAIR_SPILL_FROM");
  const std::size_t bytes = named == nullptr ? 0 : std::strtoull(named, nullptr, 10);
  return bytes == 0 ? 0 : std::max(bytes, kLeastForced);
}

// Files there take the memory that they are to spare.
bool is_in_memory(const std::string& folder) {
  struct statfs status = {};
  if (::statfs(folder.c_str(), &status) != 0) return false;
  return status.f_type == TMPFS_MAGIC || status.f_type == RAMFS_MAGIC;
}

}  // namespace

Spilling::Spilling(const std::string& folder, const MemoryLimit& limit)
    : folder_(folder.empty() ? default_folder() : folder) {
  if (limit.bytes == 0 || folder == "none") return;
  if (folder.empty() && is_in_memory(folder_)) return;
  const std::size_t forced = forced_block();
  const std::uint64_t in_memory = limit.bytes / (limit.is_share ? kInMemoryOfShare : kInMemory);
  try {
    file_ = new SpillFile(folder_, forced > 0 ? 0 : in_memory);
  } catch (const OutputError& error) {
    if (!folder.empty()) throw;
    logger().debug("{}", error.what());
    return;
  }
  resident_limit_ = forced > 0 ? std::make_shared<ResidentLimit>(*file_, 1, kTickWhenForced)
                               : std::make_shared<ResidentLimit>(*file_, limit.bytes);
  set_block_source(file_, forced > 0 ? forced : kLeastBlock);
}

// Blocks that are still in the file are given back to it later.
Spilling::~Spilling() = default;

std::uint64_t Spilling::most_bytes() const { return is_on() ? file_->most_bytes() : 0; }

std::string Spilling::why_not_more() const {
  return is_on() && file_->was_full() ? ", and the disk of " + folder_ + " is full" : "";
}

}  // namespace meshrepair
