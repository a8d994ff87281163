// What of a surface has no faults, kept apart while the rest is worked on.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <check/box_tree.h>
#include <extract/surface.h>

namespace meshrepair::internal {

// Parts whose boxes do not meet have nothing to do with each other: what crosses, or lies in,
// something else is in one group with it.
class SoundGroups {
 public:
  // Takes the groups out of the surface that have none of the triangles `at_fault`, but for the
  // smallest one: something has to be left, whatever goes of the others. To be called while it is
  // empty.
  void take_out(Surface& surface, std::span<const std::uint32_t> at_fault);

  [[nodiscard]] bool empty() const { return sound_.mesh.triangles.empty(); }
  [[nodiscard]] const TriangleSoup& mesh() const { return sound_.mesh; }

  // Puts them before the others, and is empty then. False if the others have moved to where these
  // are: now they may meet.
  [[nodiscard]] bool bring_back(Surface& surface);

 private:
  Surface sound_;
  std::vector<Box> boxes_;  // of each group
};

}  // namespace meshrepair::internal
