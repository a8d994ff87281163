#include "fill_double_walls.h"

#include <utility>
#include <vector>

#include <base/error.h>
#include <base/stage_meter.h>
#include <mesh/topology.h>

#include "again/second_repair.h"
#include "double_walls.h"

namespace meshrepair::internal {
namespace {

Surface without(const Surface& solid, const std::vector<char>& dropped) {
  std::vector<char> keep;
  keep.reserve(dropped.size());
  for (const char is_dropped : dropped) keep.push_back(is_dropped == 0 ? 1 : 0);
  Surface rest = solid;
  keep_triangles(rest, keep);
  return rest;
}

bool spared_cells(const RepairReport& report) { return report.kept_valid || report.spared_cells; }

double area_of_patches(const Sealed& sealed) {
  TriangleSoup patches;
  patches.points = sealed.surface.mesh.points;
  for (std::size_t t = 0; t < sealed.is_patch.size(); ++t) {
    if (sealed.is_patch[t] != 0) patches.triangles.push_back(sealed.surface.mesh.triangles[t]);
  }
  return surface_area(patches);
}

// The rest, its pinholes closed; nothing if it is to be certified and is not.
std::optional<Sealed> closed(const Surface& rest, const RepairOptions& options,
                             const RepairAgain& repair_again, RepairReport& report) {
  const SecondSoup second(rest);
  RepairOptions again = options_for_second(second, options);
  again.holes = {};
  try {
    Sealed sealed{repair_again(second.soup, again, report), {}};
    if (options.certify.wanted && !report.certify.passed()) return std::nullopt;
    for (const std::uint32_t source : sealed.surface.source) {
      sealed.is_patch.push_back(source == Surface::kNoSource ? 1 : 0);
    }
    refer_to_first(second, sealed.surface);
    return sealed;
  } catch (const NoSolidError&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<Sealed> fill_double_walls(const Surface& solid, const RepairOptions& options,
                                        const RepairAgain& repair_again, RepairReport& report) {
  DoubleWalls walls;
  {
    StageMeter meter(report.stages, options.progress);
    meter.begin("seal");
    walls = find_double_walls(solid, options.progress);
  }
  if (walls.bodies == 0) return std::nullopt;
  report.seal.size = walls.widest;
  RepairReport second;
  std::optional<Sealed> sealed =
      closed(without(solid, walls.is_inner), options, repair_again, second);
  if (!sealed || signed_volume(sealed->surface.mesh) <= signed_volume(solid.mesh)) {
    report.stages.insert(report.stages.end(), second.stages.begin(), second.stages.end());
    report.seal.cannot_cut = walls.bodies;
    return std::nullopt;
  }
  report.seal.double_walls = walls.bodies;
  report.seal.openings = walls.pinholes;
  report.seal.patches_area = area_of_patches(*sealed);
  report.seal.filled_volume = signed_volume(sealed->surface.mesh) - signed_volume(solid.mesh);
  const bool spared_both = spared_cells(report) && spared_cells(second);
  append_report(std::move(second), report);
  report.spared_cells = spared_both;
  return sealed;
}

}  // namespace meshrepair::internal
