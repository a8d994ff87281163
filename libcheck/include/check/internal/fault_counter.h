// SPDX-License-Identifier: MIT
// How many triangles are at fault while a few of them are changed, of a large mesh at few places.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <check/box_tree.h>
#include <check/internal/triangle_pair.h>
#include <mesh/internal/editable_mesh.h>
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

// Counts the faults of a few triangles, which are pairs that meet beyond what they share and
// triangles without area, while some points move and edges turn. Exact.
class FaultCounter {
 public:
  // `mesh` keeps its place and its triangles, and its points may move, none by more than `reach`
  // from where it is. `places` are where faults will be asked for, mostly.
  FaultCounter(const TriangleSoup& mesh, double reach, std::vector<Box> places);

  // From now on these are not what they were at first.
  void add_changed(const std::vector<std::uint32_t>& triangles);

  // Faults of these triangles; finds the others that may meet them, or what becomes of them. With
  // `moved`, that is each of them with its corners moved by no more than this.
  std::ptrdiff_t start(const EditableMesh& mesh, std::span<const std::uint32_t> triangles,
                       std::optional<double> moved = std::nullopt);

  // Of these triangles, in the order of those that start() was told of, among themselves and with
  // the others. Beyond `most` any number may be returned that is.
  std::ptrdiff_t count(const std::vector<TriangleCorners>& triangles,
                       std::ptrdiff_t most = std::numeric_limits<std::ptrdiff_t>::max());

 private:
  struct Placed {
    CornerTriangle triangle;
    Box box;
  };

  void find_others(const EditableMesh& mesh, std::span<const std::uint32_t> triangles);
  void find_others_near(const std::vector<TriangleCorners>& triangles, double moved);
  bool add(const TriangleCorners& corners, std::vector<Placed>& to) const;
  static bool meet(const Placed& a, Placed& b);

  const std::vector<Vec3d>& points_;
  double reach_;
  BoxesAround at_first_;
  std::vector<std::uint32_t> changed_;  // triangles
  std::vector<std::uint32_t> near_;     // scratch
  std::vector<Placed> others_, asked_;
  std::vector<std::uint32_t> asked_place_;  // of each one asked for, in the list of them
  std::vector<std::uint32_t> all_others_;
  std::vector<std::vector<std::uint32_t>> others_near_;  // of each in the list; empty: all
};

}  // namespace meshrepair::internal
