#include <algorithm>

#include <mesh/attributes.h>

namespace meshrepair {

const CornerAttribute* find_kind(const Attributes& attributes, CornerAttribute::Kind kind) {
  const auto found =
      std::find_if(attributes.corners.begin(), attributes.corners.end(),
                   [&](const CornerAttribute& attribute) { return attribute.kind == kind; });
  return found == attributes.corners.end() ? nullptr : &*found;
}

}  // namespace meshrepair
