// What triangles carry besides the places of their corners: texture coordinates, normals, colours,
// materials, groups.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace meshrepair {

// One value for each corner of each triangle. Corners share values by number, so that seams show:
// there two triangles have different numbers at one point.
struct CornerAttribute {
  enum class Kind {
    texture,  // coordinates in a texture, two or three
    normal,   // of length 1
    colour,   // red, green, blue
  };
  Kind kind = Kind::texture;
  std::size_t components = 2;
  std::vector<double> values;            // one after the other, `components` each
  std::vector<std::uint32_t> of_corner;  // of corner k of triangle t at 3 t + k; kNone: it has none

  [[nodiscard]] std::size_t count() const { return values.size() / components; }
};

// A name for each triangle, or none.
struct TriangleLabels {
  std::vector<std::string> names;
  std::vector<std::uint32_t> of_triangle;  // kNone: without; empty: all are without

  [[nodiscard]] bool empty() const { return of_triangle.empty(); }
};

// Of a soup, not owned: all lists have an entry for each of its triangles or corners, or are empty.
struct Attributes {
  std::vector<CornerAttribute> corners;  // at most one of each kind, in the order of the kinds
  TriangleLabels materials;
  TriangleLabels groups;
  TriangleLabels objects;
  TriangleLabels smoothing;
  std::vector<std::string> libraries;  // files that say what the materials are

  [[nodiscard]] bool empty() const {
    return corners.empty() && materials.empty() && groups.empty() && objects.empty() &&
           smoothing.empty() && libraries.empty();
  }
};

}  // namespace meshrepair
