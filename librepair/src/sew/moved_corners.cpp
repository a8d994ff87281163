#include "moved_corners.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <mesh/weld_points.h>

namespace meshrepair::internal {

void note_moved_corners(const TriangleSoup& given, Surface& surface, RepairReport& report) {
  const std::vector<std::uint32_t> place = first_in_place(given.points, surface.mesh.points);
  for (std::size_t p = 0; p < place.size(); ++p) {
    if (place[p] >= given.points.size()) surface.input_point[p] = 0;
  }
  std::vector<char> is_whole(given.triangles.size(), 0);
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    const std::uint32_t source = surface.source[t];
    if (source == Surface::kNoSource) continue;
    const auto& corners = surface.mesh.triangles[t];
    const auto& of = given.triangles[source];
    const bool has_all = std::all_of(of.begin(), of.end(), [&](std::uint32_t p) {
      return std::any_of(corners.begin(), corners.end(), [&](std::uint32_t q) {
        return surface.mesh.points[q] == given.points[p];
      });
    });
    if (has_all) is_whole[source] = 1;
  }
  const auto whole = static_cast<std::size_t>(std::count(is_whole.begin(), is_whole.end(), 1));
  TriangleFates& fates = report.triangles;
  const std::size_t all = fates.untouched + fates.cut;
  fates.untouched = std::min(whole, fates.untouched);
  fates.cut = all - fates.untouched;
}

}  // namespace meshrepair::internal
