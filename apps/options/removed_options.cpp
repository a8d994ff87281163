// SPDX-License-Identifier: MIT
#include "options/removed_options.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <spdlog/fmt/fmt.h>

#include "options/command_line.h"

namespace meshrepair {
namespace {

struct RemovedOption {
  std::string_view name, value;  // that did something
  // The same is done by these; empty: by all programs without them.
  std::string_view other, other_value;
};

constexpr std::array<RemovedOption, 4> kRemoved = {{{"attributes", "drop", "drop", "all"},
                                                    {"only", "outer", "cavities", "fill"},
                                                    {"check-cells", "", "", ""},
                                                    {"regions", "", "", ""}}};

std::string spelled(std::string_view name, std::string_view value, Spelling spelling) {
  if (spelling == Spelling::keywords) return fmt::format("{}=\"{}\"", name, value);
  return fmt::format("--{} {}", name, value);
}

}  // namespace

std::string why_removed(const CommandLine& line, const std::string& name, Spelling spelling) {
  const auto found =
      std::find_if(kRemoved.begin(), kRemoved.end(), [&](const RemovedOption& removed) {
        return name.starts_with("--") && name.substr(2) == removed.name;
      });
  if (found == kRemoved.end() || line.find(name) != nullptr) return {};
  if (found->other.empty()) return "is gone: leave it out, the result is the same";
  if (line.find(fmt::format("--{}", found->other)) == nullptr) return {};
  return fmt::format("is gone: use {} for {}", spelled(found->other, found->other_value, spelling),
                     spelled(found->name, found->value, spelling));
}

}  // namespace meshrepair
