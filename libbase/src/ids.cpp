// SPDX-License-Identifier: MIT
#include <string>

#include <base/error.h>
#include <base/ids.h>

namespace meshrepair {

void refuse_ids(std::size_t most, const char* name) {
  throw LimitError("more than " + std::to_string(most) + " " + name);
}

}  // namespace meshrepair
