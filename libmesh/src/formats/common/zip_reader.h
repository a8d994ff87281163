// SPDX-License-Identifier: MIT
// A ZIP archive in memory. It is not trusted: nothing of it is written to a disk, and no more comes
// out of it than archives of its size hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <mesh/mesh_source.h>

#include "unpack_budget.h"

struct zip;

namespace meshrepair {

class ZipReader {
 public:
  struct Entry {
    std::string name;  // as it stands there, but relative, with '/' between folders
    std::uint64_t number = 0;
    std::uint64_t size = 0;    // as declared
    std::uint64_t packed = 0;  // as declared
    bool encrypted = false;
  };

  // The source has to stay. Throws InputError when it is no archive that can be read.
  explicit ZipReader(const MeshSource& source);

  // Without folders, and without entries whose name leads out of the archive or was there before.
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  [[nodiscard]] std::size_t passed_over() const { return passed_over_; }

  // By a name as part_key() takes it. Null: there is none.
  [[nodiscard]] const Entry* find(std::string_view name) const;

  // Calls sink(bytes) for one piece after the other. Throws InputError when the entry is encrypted,
  // damaged, packed by an unknown method, or larger than it says; or when all that was read is more
  // than an archive of this size can hold.
  void read(const Entry& entry, const std::function<void(std::string_view)>& sink);
  // All of it.
  [[nodiscard]] std::string text_of(const Entry& entry);

 private:
  struct Discard {
    void operator()(zip* archive) const;
  };

  void add_entry(std::uint64_t number);

  const MeshSource& source_;
  std::unique_ptr<zip, Discard> archive_;
  std::vector<Entry> entries_;
  std::unordered_map<std::string, std::size_t> by_key_;  // see part_key()
  std::size_t passed_over_ = 0;
  UnpackBudget budget_;
};

}  // namespace meshrepair
