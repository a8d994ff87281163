// SPDX-License-Identifier: MIT
#include "saved_states.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include <base/internal/hash_index.h>
#include <base/parallel.h>

namespace meshrepair::internal {
namespace {

constexpr std::size_t kBytesPerTask = std::size_t{1} << 20;

std::uint64_t hash_of_bytes(const char* bytes, std::size_t size) {
  std::uint64_t hash = hash_mix(0, size);
  std::uint64_t word = 0;
  for (; size >= sizeof word; bytes += sizeof word, size -= sizeof word) {
    std::memcpy(&word, bytes, sizeof word);
    hash = hash_mix(hash, word);
  }
  word = 0;
  std::memcpy(&word, bytes, size);
  return hash_mix(hash, word);
}

template <class T>
std::uint64_t hash_of_list(const std::vector<T>& list) {
  const char* const bytes = reinterpret_cast<const char*>(list.data());
  const std::size_t size = list.size() * sizeof(T);
  return parallel_reduce(
      size, kBytesPerTask,
      [&](std::size_t first, std::size_t last) {
        return hash_of_bytes(bytes + first, last - first);
      },
      [](std::uint64_t& all, std::uint64_t part) { all = hash_mix(all, part); });
}

}  // namespace

// Options of one run differ from mesh to mesh in what they say of triangles.
SavedStates::SavedStates(const TriangleSoup& soup, const RepairOptions& options)
    : store_(options.states) {
  if (store_ == nullptr) return;
  std::uint64_t hash = 0;
  for (const std::uint64_t part : {hash_of_list(soup.points), hash_of_list(soup.triangles),
                                   hash_of_list(options.opacity), hash_of_list(options.reach)}) {
    hash = hash_mix(hash, part);
  }
  soup_ = std::to_string(hash);
}

std::string SavedStates::name_of(const std::string& state) const { return state + '-' + soup_; }

bool SavedStates::has(const std::string& name) const {
  return store_ != nullptr && store_->has(name_of(name));
}

void SavedStates::drop(const std::string& name) {
  if (store_ != nullptr) store_->drop(name_of(name));
}

std::optional<Surface> made_once(SavedStates& states, const std::string& name, RepairReport& report,
                                 std::vector<StageReport>& stages, StageMeter& meter,
                                 const std::function<std::optional<Surface>()>& make) {
  std::optional<Surface> made;
  std::vector<StageReport> its_stages;
  if (states.has(name)) {
    meter.begin("resume");
    const bool is_there = states.load(name, made, report, its_stages);
    meter.end();
    if (is_there) {
      stages.insert(stages.end(), its_stages.begin(), its_stages.end());
      return made;
    }
  }
  const auto before = static_cast<std::ptrdiff_t>(stages.size());
  made = make();
  meter.end();
  its_stages.assign(stages.begin() + before, stages.end());
  states.save(name, made, report, its_stages);
  return made;
}

}  // namespace meshrepair::internal
