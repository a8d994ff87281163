// SPDX-License-Identifier: MIT
// Only Linux has a file for large arrays. MESHREPAIR_NO_SPILLING says where there is none, and what
// there is instead, such as "on Windows, whose paging file holds large arrays".
#include <string>

#include <base/error.h>

#include "spill/spilling.h"

namespace meshrepair {

Spilling::Spilling(const std::string& folder, const MemoryLimit& /*limit*/) {
  if (!folder.empty() && folder != "none") {
    throw UsageError("--temp: cannot be used " MESHREPAIR_NO_SPILLING);
  }
}
Spilling::~Spilling() = default;
std::uint64_t Spilling::most_bytes() const { return 0; }
std::string Spilling::why_not_more() const { return {}; }

}  // namespace meshrepair
