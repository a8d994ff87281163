// SPDX-License-Identifier: MIT
// What a PLY file says of points and faces besides their places: colours, normals, texture
// coordinates, and whatever numbers its properties hold.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <mesh/attributes.h>
#include <mesh/mesh_source.h>

#include "formats/common/face_list.h"
#include "ply_header.h"

namespace meshrepair {

// Takes items as the reader meets them.
class PlyAttributes {
 public:
  PlyAttributes(const MeshSource& source, const PlyHeader& header);

  // Before the items of an element. Only those of `vertex` and `face` say something.
  void begin_element(const PlyElement& element);
  // A value of the property with this number; for a list, the next.
  void add(std::size_t property, double value);
  // The item is one of the mesh, or not.
  void end_point();
  void end_face(std::size_t corners);
  void forget_item();
  // The last face is none after all; that many corners are left.
  void drop_face(std::size_t corners);

  // For triangles with these origins, and corners at these points. Faces that are not of the
  // element `face` have no values of their own: `with_faces` is false if there are such.
  [[nodiscard]] Attributes take(const std::vector<FaceList::Origin>& origins,
                                const std::vector<std::array<std::uint32_t, 3>>& triangles,
                                bool with_faces);

 private:
  static constexpr std::size_t kNoColumn = ~std::size_t{0};

  // Properties of one element that make one attribute.
  struct Group {
    CornerAttribute attribute;
    std::vector<std::size_t> properties;
    bool is_list = false;  // of all corners, one after the other
  };
  // What a property of faces numbers, by comments of the header.
  struct Named {
    std::vector<std::string> names;
    std::size_t property = kNoColumn;
    std::vector<double> of_face;

    [[nodiscard]] bool is_there() const { return property != kNoColumn; }
    [[nodiscard]] TriangleLabels take(const std::vector<FaceList::Origin>& origins);
  };
  // Of `vertex` or `face`.
  struct Element {
    std::vector<Group> groups;
    std::vector<std::size_t> group_of, component_of;  // of each property; kNoColumn: none
    bool any() const { return !group_of.empty(); }
  };

  void find_element(std::string_view name, const PlyHeader& header, Element& found);
  void find_groups(const PlyElement& element, Element& found);
  [[nodiscard]] bool is_name(std::size_t property) const;
  void add_group(const PlyElement& element, CornerAttribute::Kind kind,
                 const std::vector<std::string_view>& names, std::size_t least,
                 Element& found) const;
  void add_list(const PlyElement& element, std::size_t property, Element& found) const;
  void add_others(const PlyElement& element, Element& found) const;
  void keep_row();
  void end_lists(std::size_t corners);
  [[nodiscard]] CornerAttribute take_of_points(
      Group& group, const std::vector<std::array<std::uint32_t, 3>>& triangles) const;
  [[nodiscard]] CornerAttribute take_of_faces(Group& group,
                                              const std::vector<FaceList::Origin>& origins) const;
  void take_materials(const std::vector<FaceList::Origin>& origins, Attributes& attributes);

  const MeshSource& source_;
  Element points_, faces_;
  Element* current_ = nullptr;
  std::vector<double> row_;                // of the item, by property
  std::vector<std::vector<double>> list_;  // of the item, by group
  Named materials_, textures_, groups_, objects_;
};

}  // namespace meshrepair
