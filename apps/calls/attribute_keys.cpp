// SPDX-License-Identifier: MIT
#include "calls/attribute_keys.h"

#include <array>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include <base/error.h>
#include <mesh/skins.h>

namespace meshrepair {
namespace {

using Kind = CornerAttribute::Kind;

constexpr std::array<std::pair<std::string_view, Kind>, 5> kKinds = {
    {{"texture", Kind::texture},
     {"normal", Kind::normal},
     {"tangent", Kind::tangent},
     {"colour", Kind::colour},
     {"skin_weights", Kind::skin}}};

bool can_have(Kind kind, std::size_t components) {
  const auto is_in = [&](std::size_t least, std::size_t most) {
    return components >= least && components <= most;
  };
  switch (kind) {
    case Kind::texture:
      return is_in(2, 3);
    case Kind::normal:
      return is_in(3, 3);
    case Kind::tangent:
      return is_in(4, 4);
    case Kind::colour:
      return is_in(3, 4);
    case Kind::skin:
      return components % kSkinSet == 0 && is_in(kSkinSet, 8 * kSkinSet);
    case Kind::other:
      break;
  }
  return is_in(1, 16);
}

}  // namespace

std::string attribute_key(const CornerAttribute& attribute, std::size_t n) {
  for (const auto& [name, kind] : kKinds) {
    if (kind != attribute.kind) continue;
    return n == 0 ? std::string(name) : fmt::format("{}_{}", name, n);
  }
  return attribute.name.empty() ? fmt::format("other_{}", n) : attribute.name;
}

Kind kind_of_key(std::string_view key) {
  for (const auto& [name, kind] : kKinds) {
    if (!key.starts_with(name)) continue;
    const std::string_view rest = key.substr(name.size());
    const bool is_number = rest.size() > 1 && rest[0] == '_' &&
                           rest.find_first_not_of("0123456789", 1) == std::string_view::npos;
    if (rest.empty() || is_number) return kind;
  }
  return Kind::other;
}

void check_components(const CornerAttribute& attribute, const std::string& name) {
  if (can_have(attribute.kind, attribute.components)) return;
  throw UsageError(fmt::format("{} cannot have {} numbers a row", name, attribute.components));
}

}  // namespace meshrepair
