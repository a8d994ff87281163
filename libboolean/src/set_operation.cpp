// SPDX-License-Identifier: MIT
#include <boolean/set_operation.h>

namespace meshrepair {

std::string_view operation_name(SetOperation operation) {
  switch (operation) {
    case SetOperation::unite:
      return "union";
    case SetOperation::intersect:
      return "intersection";
    case SetOperation::subtract:
      return "difference";
    case SetOperation::exclude:
      return "xor";
  }
  return "?";
}

}  // namespace meshrepair
