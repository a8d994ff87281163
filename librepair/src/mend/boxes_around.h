// Which triangles of a large mesh are near a few places.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <check/box_tree.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

// Looks through all triangles once, for those near the places, and makes a tree of all only when
// something is asked for elsewhere.
class BoxesAround {
 public:
  // `mesh` keeps its place and its triangles. Boxes are of where its points are now, or later, for
  // those of triangles that are elsewhere.
  BoxesAround(const TriangleSoup& mesh, std::vector<Box> places);

  // Appends the triangles whose boxes meet this one.
  void find(const Box& box, std::vector<std::uint32_t>& found);

 private:
  [[nodiscard]] bool is_at_a_place(const Box& box) const;
  void take(std::vector<std::uint32_t> triangles);
  void take_all();

  const TriangleSoup& mesh_;
  std::vector<Box> places_;
  bool has_all_ = false;
  std::vector<std::uint32_t> triangles_;  // in the tree
  std::vector<Box> boxes_;                // of them
  std::optional<BoxTree> tree_;
};

}  // namespace meshrepair::internal
