// SPDX-License-Identifier: MIT
// Spaces that may lie behind narrow openings: a quick look, before these are looked for.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <base/progress.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

// Looks at places that are equally far apart, kSide of them along the longest side of a mesh.
class WideSpaces {
 public:
  static constexpr int kSide = 40;

  // The mesh bounds a solid. n log n. Throws Cancelled.
  WideSpaces(const TriangleSoup& mesh, ProgressObserver* progress);

  // Whether a ball of twice this diameter, which is at most an eighth of the diagonal of the mesh's
  // bounding box, has room where one of this diameter may not come to from outside; not in a void
  // that no way leads into. Spaces in which no place is farther from the mesh than places are apart
  // are not seen.
  [[nodiscard]] bool lie_behind(double diameter) const;

 private:
  void lay_out(const TriangleSoup& mesh);
  void measure(const TriangleSoup& mesh);
  void leave_empty_spaces(const TriangleSoup& mesh, ProgressObserver* progress);
  [[nodiscard]] Vec3d at(std::size_t place) const;
  // The places to which a way leads from one that is nowhere nearer to the mesh than this; not
  // through those that are reached already, among which they are then.
  std::vector<std::size_t> flood(std::size_t from, double clearance,
                                 std::vector<char>& reached) const;

  double step_ = 0;
  Vec3d low_ = Vec3d::Zero();
  std::array<std::size_t, 3> size_ = {0, 0, 0};
  std::vector<float> clearance_;  // of each place from the mesh; 0 in solids and voids
};

}  // namespace meshrepair::internal
