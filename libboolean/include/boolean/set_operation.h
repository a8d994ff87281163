// SPDX-License-Identifier: MIT
// What can be done with two solids as sets of points.
#pragma once

#include <optional>
#include <string_view>

#include <bsp/tree.h>

namespace meshrepair {

enum class SetOperation { unite, intersect, subtract, exclude };

// union, intersection, difference, xor.
[[nodiscard]] std::string_view operation_name(SetOperation operation);

// Of what is in the first solid or not, and in the second or not; both are known.
[[nodiscard]] inline Label combine(SetOperation operation, Label first, Label second) {
  const bool a = first == Label::solid;
  const bool b = second == Label::solid;
  bool result = false;
  switch (operation) {
    case SetOperation::unite:
      result = a || b;
      break;
    case SetOperation::intersect:
      result = a && b;
      break;
    case SetOperation::subtract:
      result = a && !b;
      break;
    case SetOperation::exclude:
      result = a != b;
      break;
  }
  return result ? Label::solid : Label::empty;
}

// What the result is whatever the second solid, if that is so.
[[nodiscard]] inline std::optional<Label> decided_by(SetOperation operation, Label first) {
  const Label outside = combine(operation, first, Label::empty);
  if (outside != combine(operation, first, Label::solid)) return std::nullopt;
  return outside;
}

}  // namespace meshrepair
