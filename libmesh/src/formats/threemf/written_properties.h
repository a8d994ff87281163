// SPDX-License-Identifier: MIT
// Attributes of a soup as property groups of a 3MF model.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <mesh/attributes.h>
#include <mesh/soup.h>

#include "kept_parts.h"

namespace meshrepair {

// A picture that becomes a part of the package.
struct WrittenPicture {
  std::string name;  // of the part
  std::string media_type;
  std::shared_ptr<const std::string> bytes;
  std::uint32_t image = kNone;  // of the attributes
};

struct WrittenProperties {
  struct OfTriangle {
    std::uint32_t group = kNone;
    std::array<std::uint32_t, 3> index = {0, 0, 0};
  };

  std::string resources;  // the elements, in the order that they need
  std::uint32_t next_id = 1;
  std::vector<OfTriangle> of_triangle;  // empty: none has any
  OfTriangle of_object;                 // what triangles without have; of its indices the first
  std::vector<WrittenPicture> pictures;
};

// `material` is the prefix of the namespace of the materials extension. A triangle that has a
// material and more, or a texture and colours, gets an entry of a multiproperties group. Names of
// materials with pictures become names of these parts, which may not be any of `kept` (may be
// null). Ids below `first_id` are taken.
[[nodiscard]] WrittenProperties write_properties(const TriangleSoup& soup,
                                                 const Attributes& attributes,
                                                 const KeptPackage* kept,
                                                 const std::string& material,
                                                 std::uint32_t first_id);

}  // namespace meshrepair
