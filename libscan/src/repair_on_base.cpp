#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include <mesh/weld_points.h>
#include <scan/repair_on_base.h>

namespace meshrepair {
namespace {

TriangleSoup welded(TriangleSoup soup) {
  const std::vector<std::uint32_t> first = first_in_place(soup.points);
  for (auto& triangle : soup.triangles) {
    for (std::uint32_t& corner : triangle) corner = first[corner];
  }
  return soup;
}

bool has_corners_of_source(const TriangleSoup& soup, const Surface& surface, std::size_t t) {
  const auto& of_result = surface.mesh.triangles[t];
  const auto& of_source = soup.triangles[surface.source[t]];
  return std::all_of(of_result.begin(), of_result.end(), [&](std::uint32_t p) {
    return std::any_of(of_source.begin(), of_source.end(),
                       [&](std::uint32_t q) { return surface.mesh.points[p] == soup.points[q]; });
  });
}

// Walls and the floor are made up, and no triangles of the input.
void forget_base(const TriangleSoup& soup, Surface& surface, RepairReport& report) {
  enum : char { absent, cut, whole };
  std::vector<char> fate(soup.triangles.size(), absent);
  TriangleSoup made_up;
  for (std::size_t t = 0; t < surface.source.size(); ++t) {
    std::uint32_t& source = surface.source[t];
    if (source >= soup.triangles.size()) {
      source = Surface::kNoSource;
      made_up.triangles.push_back(surface.mesh.triangles[t]);
    } else if (fate[source] != whole) {
      fate[source] = has_corners_of_source(soup, surface, t) ? whole : cut;
    }
  }
  made_up.points = surface.mesh.points;
  report.closing_area = surface_area(made_up);
  report.clean.triangles_in = soup.triangles.size();
  report.triangles.untouched =
      static_cast<std::size_t>(std::count(fate.begin(), fate.end(), whole));
  report.triangles.cut = static_cast<std::size_t>(std::count(fate.begin(), fate.end(), cut));
  report.triangles.rounded = std::min(report.triangles.rounded, report.triangles.cut);
}

}  // namespace

Surface repair_on_base(const TriangleSoup& soup, const ScanBaseOptions& base,
                       const RepairOptions& options, ScanBaseReport& stands, RepairReport& report) {
  ScanBaseOptions all_parts = base;
  all_parts.smallest_part = 0;
  RepairOptions of_any_size = options;
  of_any_size.holes.largest_share = of_any_size.holes.largest_flat_share =
      std::numeric_limits<double>::max();
  Surface surface = repair(with_base(welded(soup), all_parts, stands), of_any_size, report);
  forget_base(soup, surface, report);
  if (options.explain) report.explanation.fates.resize(soup.triangles.size());
  return surface;
}

}  // namespace meshrepair
