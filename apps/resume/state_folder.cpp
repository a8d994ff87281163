// SPDX-License-Identifier: MIT
#include "resume/state_folder.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include <spdlog/logger.h>

#include <base/error.h>
#include <base/internal/hash_index.h>
#include <base/internal/system.h>

#include "process/file_checksum.h"
#include "resume/state_file.h"
#include "terminal/logging.h"
#include "terminal/warning_log.h"

namespace meshrepair {
namespace {

namespace fs = std::filesystem;

// Of names of files: what else is in the folder is not touched.
constexpr std::string_view kPrefix = "meshrepair-";
constexpr std::string_view kExtension = ".state";
constexpr std::string_view kUnfinished = ".part";

constexpr int kTries = 20;
constexpr std::chrono::milliseconds kBetweenTries{100};

std::string reason(int error) { return std::generic_category().message(error); }

// States are read as they lie in memory, so they are of one build.
std::uint64_t key_of(const std::string& options) {
  std::uint64_t hash = program_checksum();
  for (const char c : options) hash = internal::hash_mix(hash, static_cast<unsigned char>(c));
  return internal::hash_mix(hash, options.size());
}

// A run that was killed may take a moment to be gone.
int held(const fs::path& folder) {
  for (int i = 0; i < kTries; ++i) {
    const int lock = internal::hold_folder(folder);
    if (lock >= 0) return lock;
    if (errno != EWOULDBLOCK) {
      const int error = errno;
      const bool is_folder = internal::facts_of_file(folder).kind == internal::FileKind::folder;
      throw OutputError("--resume: " + folder.string() +
                        (is_folder ? " cannot be locked: " : " is no folder: ") + reason(error));
    }
    std::this_thread::sleep_for(kBetweenTries);
  }
  throw OutputError("--resume: another run is at work with " + folder.string());
}

// meshrepair-<state>-<number>.state, or .part
bool has_our_name(const fs::path& file) {
  const std::string extension = file.extension().string(), name = file.stem().string();
  if (!name.starts_with(kPrefix)) return false;
  if (extension != kExtension && extension != kUnfinished) return false;
  const std::size_t dash = name.rfind('-');
  return dash >= kPrefix.size() && dash + 1 < name.size() &&
         name.find_first_not_of("0123456789", dash + 1) == std::string::npos;
}

bool is_ours(const fs::directory_entry& entry) {
  std::error_code failed;
  const fs::path& file = entry.path();
  return entry.symlink_status(failed).type() == fs::file_type::regular && has_our_name(file) &&
         (file.extension() == kUnfinished || key_of_state(file));
}

template <class Act>
void for_each_of_ours(const fs::path& folder, const Act& act) {
  std::error_code failed;
  for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
    if (is_ours(*at)) act(at->path());
  }
}

}  // namespace

StateFolder::StateFolder(fs::path folder, const std::string& options)
    : folder_(std::move(folder)), lock_(held(folder_)), key_(key_of(options)) {}

// What nothing is kept in goes, also after an error.
StateFolder::~StateFolder() { internal::release_folder(folder_, lock_); }

fs::path StateFolder::path_of(const std::string& name, std::string_view extension) const {
  return folder_ / (std::string(kPrefix) + name + std::string(extension));
}

bool StateFolder::has(const std::string& name) const {
  std::error_code failed;
  const fs::path file = path_of(name, kExtension);
  return fs::symlink_status(file, failed).type() == fs::file_type::regular &&
         key_of_state(file) == key_;
}

bool StateFolder::load(const std::string& name,
                       const std::function<void(std::istream&, std::uint64_t)>& read) {
  const fs::path file = path_of(name, kExtension);
  if (!has(name)) return false;
  if (!read_state(file, read)) {
    warn("--resume", {WarningCode::states_not_saved, file.string() + " is damaged and ignored"});
    drop(name);
    return false;
  }
  logger().info("goes on from {}", file.string());
  if (std::find(saved_.begin(), saved_.end(), name) == saved_.end()) loaded_.push_back(name);
  return true;
}

void StateFolder::save(const std::string& name, const std::function<void(std::ostream&)>& write) {
  if (!may_save_) return;
  if (saved_.empty()) remove_others();
  const fs::path unfinished = path_of(name, kUnfinished);
  try {
    write_state(unfinished, key_, write);
    fs::rename(unfinished, path_of(name, kExtension));
    internal::flush_folder(folder_);
    saved_.push_back(name);
  } catch (const fs::filesystem_error& error) {
    may_save_ = false;
    warn("--resume", {WarningCode::states_not_saved,
                      unfinished.string() + " cannot be written; later progress is not saved: " +
                          error.code().message()});
    std::error_code failed;
    fs::remove(unfinished, failed);
  }
}

void StateFolder::drop(const std::string& name) {
  std::error_code failed;
  fs::remove(path_of(name, kExtension), failed);
}

void StateFolder::remove() noexcept {
  remove_those([this](const fs::path& file) {
    return file.extension() == kUnfinished || key_of_state(file) == key_;
  });
}

// A run that gets nowhere, by a mistake of who calls it, leaves them.
void StateFolder::remove_others() noexcept {
  remove_those([this](const fs::path& file) {
    return file.extension() == kUnfinished || key_of_state(file) != key_;
  });
}

void StateFolder::remove_those(const std::function<bool(const fs::path&)>& are_meant) noexcept {
  std::error_code failed;
  for_each_of_ours(folder_, [&](const fs::path& file) {
    if (are_meant(file)) fs::remove(file, failed);
  });
}

}  // namespace meshrepair
