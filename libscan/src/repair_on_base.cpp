#include <cstdint>
#include <limits>

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

}  // namespace

Surface repair_on_base(const TriangleSoup& soup, const ScanBaseOptions& base,
                       const RepairOptions& options, ScanBaseReport& stands, RepairReport& report) {
  ScanBaseOptions all_parts = base;
  all_parts.smallest_part = 0;
  RepairOptions of_any_size = options;
  of_any_size.holes.largest_share = of_any_size.holes.largest_flat_share =
      std::numeric_limits<double>::max();
  const auto given = static_cast<std::uint32_t>(soup.triangles.size());
  Surface surface = repair(with_base(welded(soup), all_parts, stands), of_any_size, report);
  report.clean.triangles_in = given;
  for (std::uint32_t& source : surface.source) {
    if (source != Surface::kNoSource && source >= given) source = Surface::kNoSource;
  }
  if (options.explain) report.explanation.fates.resize(given);
  return surface;
}

}  // namespace meshrepair
