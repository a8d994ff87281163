// SPDX-License-Identifier: MIT
// What becomes of a surface once it is extracted.
#include <limits>
#include <optional>
#include <utility>

#include <base/error.h>

#include "certify_surface.h"
#include "common/drop_thin_parts.h"
#include "make_surface.h"
#include "report/describe_result.h"
#include "simplify_surface.h"

namespace meshrepair::internal {
namespace {

// Whatever is beyond would be written as infinity.
void require_range(const Surface& surface, Precision precision) {
  if (precision == Precision::float64) return;
  for (const Vec3d& p : surface.mesh.points) {
    if (p.cwiseAbs().maxCoeff() <= static_cast<double>(std::numeric_limits<float>::max())) continue;
    throw OutputError(
        "coordinates are too large for single precision: write OBJ, OFF or PLY in double "
        "precision");
  }
}

// What is thinner than a step of the grid says nothing about the input, whose points were put
// there. Returns which of the triangles left are whole.
std::vector<char> drop_crumbs(const CleanSoup& input, Surface& surface, RepairReport& report) {
  std::vector<char> whole = find_whole_triangles(input, surface);
  report.crumbs = drop_thin_crumbs(surface, whole, input.grid.unit);
  return report.crumbs > 0 ? find_whole_triangles(input, surface) : std::move(whole);
}

}  // namespace

Surface finish_surface(const CleanSoup& input, Surface surface, const RepairOptions& options,
                       RepairReport& report, StageMeter& meter) {
  require_range(surface, options.certify.precision);
  const std::vector<char> whole = drop_crumbs(input, surface, report);
  if (options.examine) {
    describe_result(input, surface, report);
    options.examine(report);
  }
  report.simplify = {};
  Simplifier simplifier(options, report.simplify);
  std::optional<Surface> simpler;
  if (options.simplify > 0) {
    meter.begin("simplify");
    simplifier.keep_points_of(surface, whole);
    simpler = simplifier.simplified(surface);
  }
  if (options.certify.wanted) {
    meter.begin("certify");
    surface = certify_surface(std::move(surface), std::move(simpler), simplifier, input.grid,
                              options, report.certify);
  } else if (simpler) {
    surface = std::move(*simpler);
  }
  meter.begin("check");
  describe_result(input, surface, report);
  return surface;
}

}  // namespace meshrepair::internal
