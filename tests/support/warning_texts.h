// SPDX-License-Identifier: MIT
// What warnings say, to be compared with texts. Found by the type of its argument.
#pragma once

#include <string>
#include <vector>

#include <base/warning.h>

namespace meshrepair {

inline std::vector<std::string> texts(const std::vector<Warning>& warnings) {
  std::vector<std::string> texts;
  for (const Warning& warning : warnings) texts.push_back(warning.text);
  return texts;
}

}  // namespace meshrepair
