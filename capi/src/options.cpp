// SPDX-License-Identifier: MIT
// Options of the C interface: kept as they are said; the calls know which there are.
#include <algorithm>
#include <string>

#include <base/error.h>

#include "handles.h"

namespace meshrepair {
namespace {

bool is_same_name(const std::string& a, const std::string& b) {
  const auto plain = [](char c) { return c == '_' ? '-' : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return plain(x) == plain(y); });
}

}  // namespace
}  // namespace meshrepair

using namespace meshrepair;

meshrepair_options* meshrepair_options_new() {
  meshrepair_options* options = nullptr;
  (void)guarded([&] { options = new meshrepair_options; });
  return options;
}

void meshrepair_options_free(meshrepair_options* options) { delete options; }

meshrepair_code meshrepair_options_set(meshrepair_options* options, const char* name,
                                       const char* value) {
  return guarded([&] {
    if (options == nullptr) throw UsageError("there is NULL for options");
    if (name == nullptr || *name == '\0') throw UsageError("the option has no name");
    Keyword keyword(name, true);
    if (value != nullptr) keyword.second = std::string(value);
    const auto is_set = [&](const Keyword& set) { return is_same_name(set.first, keyword.first); };
    const auto before = std::find_if(options->keywords.begin(), options->keywords.end(), is_set);
    if (before == options->keywords.end()) {
      options->keywords.push_back(std::move(keyword));
    } else {
      *before = std::move(keyword);
    }
  });
}

void meshrepair_options_set_progress(meshrepair_options* options, meshrepair_progress told,
                                     void* data) {
  if (options == nullptr) return;
  options->told = told;
  options->data = data;
}
