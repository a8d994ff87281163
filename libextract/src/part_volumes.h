// Which parts of a mesh have become larger or smaller?
#pragma once

#include <cstdint>
#include <vector>

#include <bsp/soup.h>

namespace meshrepair::internal {

// Of the parts of a closed mesh, connected through edges; each seen from a point of its own, as
// rounding would leave nothing of the volumes of small ones far away.
class PartVolumes {
 public:
  explicit PartVolumes(const TriangleSoup& mesh);

  // The triangles of parts whose mean thickness, six times the volume over the area, is less than
  // this.
  [[nodiscard]] std::vector<char> in_thin_parts(const TriangleSoup& mesh, double thickness) const;

  // `mesh` is the one at first with other corners and fewer triangles, `was` says which of those
  // each was. Of the triangles `changed` those in parts whose volume is not what it was, by a
  // tenth.
  [[nodiscard]] std::vector<std::uint32_t> altered(const TriangleSoup& mesh,
                                                   const std::vector<std::uint32_t>& was,
                                                   const std::vector<std::uint32_t>& changed) const;

 private:
  [[nodiscard]] std::vector<double> volumes(const TriangleSoup& mesh,
                                            const std::vector<std::uint32_t>& part_of) const;

  std::vector<std::uint32_t> part_of_;  // of each triangle; numbered by their first ones
  std::vector<Vec3d> origins_;          // of each part, one of its points
  std::vector<double> before_;
  double unit_ = 1;  // a power of two, so that the result does not depend on that of the mesh
};

}  // namespace meshrepair::internal
