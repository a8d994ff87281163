#include "describe_result.h"

#include <mesh/topology.h>

namespace meshrepair::internal {
namespace {

double closing_area(const Surface& surface) {
  TriangleSoup closing;
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    if (surface.source[t] == Surface::kNoSource) {
      closing.triangles.push_back(surface.mesh.triangles[t]);
    }
  }
  if (closing.triangles.empty()) return 0;
  closing.points = surface.mesh.points;
  return surface_area(closing);
}

}  // namespace

void describe_result(const CleanSoup& input, const Surface& surface, RepairReport& report) {
  report.triangles = find_triangle_fates(input, report.parts, surface);
  describe_output(surface, report);
}

void describe_output(const Surface& surface, RepairReport& report) {
  report.output = examine_topology(surface.mesh.triangles, surface.mesh.points.size());
  report.output_volume = signed_volume(surface.mesh);
  report.output_area = surface_area(surface.mesh);
  report.closing_area = closing_area(surface);
}

}  // namespace meshrepair::internal
