// SPDX-License-Identifier: MIT
// What a program does where its large arrays would take more memory than it may have.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "process/memory_limit.h"

namespace meshrepair {

class ResidentLimit;
class SpillFile;

// As long as it is there, memory that is allocated from a quarter of the limit on comes from a
// file, and what of it is in memory is kept within the limit. Of a share of the machine it is a
// half.
class Spilling {
 public:
  // `folder` is that of the file. Empty: the one that $TMPDIR names, or else /var/tmp; if no file
  // can be made there, or it would be in memory itself, there is no spilling. "none", or no limit:
  // there is none either. Throws OutputError where no file can be made in a folder that is named.
  Spilling(const std::string& folder, const MemoryLimit& limit);
  Spilling(const Spilling&) = delete;
  Spilling& operator=(const Spilling&) = delete;
  ~Spilling();

  [[nodiscard]] bool is_on() const { return file_ != nullptr; }
  // Of blocks in the file at a time; 0 if it was not needed.
  [[nodiscard]] std::uint64_t most_bytes() const;
  // " and the disk of DIR is full" if it was, for a message.
  [[nodiscard]] std::string why_not_more() const;

 private:
  std::string folder_;
  SpillFile* file_ = nullptr;  // never deleted: arrays of the whole process may be in it
  std::shared_ptr<ResidentLimit> resident_limit_;  // shared, as not all systems know the type
};

}  // namespace meshrepair
