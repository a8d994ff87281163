// From outside to inside:
//
// - A grid of cubes is laid around the surface, or around its narrow places, and a ball rolls
//   through it: openings.h. That tells where openings are, as well as cubes can.
// - There the faces of the cubes are added to the surface, and all is cut exactly. Of the faces the
//   smallest are taken that part what is behind from what is before: closed_openings.h. That closes
//   what there is, whatever cubes have missed.
#include "seal_solid.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <base/error.h>

#include "again/second_repair.h"
#include "arrange/chamber_surface.h"
#include "closed_openings.h"
#include "report/describe_result.h"
#include "surface/make_surface.h"

namespace meshrepair::internal {
namespace {

// Nothing if it is to be certified and is not.
std::optional<Surface> extract_sealed(const ClosedOpenings& sealed, const RepairOptions& options,
                                      RepairReport& report) {
  StageMeter meter(report.stages, options.progress);
  meter.begin("extract");
  std::optional<Surface> surface =
      boundary_of_chambers(sealed.soup, *sealed.arrangement, sealed.filled.solid, options, report);
  if (!surface) return std::nullopt;
  surface = finish_surface(sealed.soup, std::move(*surface), options, report, meter);
  if (options.certify.wanted && !report.certify.passed()) return std::nullopt;
  refer_to_first(sealed.second, *surface);
  return surface;
}

// Certified, where need be by repairing it once more.
Surface surface_of(const ClosedOpenings& sealed, const RepairOptions& options,
                   const RepairAgain& repair_again, RepairReport& report) {
  RepairOptions second = options_for_second(sealed.second, options);
  std::optional<Surface> surface = extract_sealed(sealed, second, report);
  if (surface) return std::move(*surface);
  second.certify.wanted = false;
  second.slit_steps = 0;
  second.simplify = 0;
  report = {};
  surface = extract_sealed(sealed, second, report);
  if (!surface) throw InternalError("openings are sealed, but what is solid then has no boundary");
  const SecondSoup third(*surface);
  report = {};
  Surface repaired = repair_again(third.soup, options_for_second(third, options), report);
  refer_to_first(third, repaired);
  return repaired;
}

// How many pieces of each triangle of the soup a surface has, and whether they have only corners of
// it.
struct Pieces {
  std::vector<std::uint32_t> count;
  std::vector<char> is_whole;

  Pieces(std::size_t triangles, const Surface& surface)
      : count(triangles, 0), is_whole(triangles, 0) {
    for (std::size_t t = 0; t < surface.source.size(); ++t) {
      const std::uint32_t source = surface.source[t];
      if (source == Surface::kNoSource) continue;
      const auto& c = surface.mesh.triangles[t];
      const bool is_given = std::all_of(
          c.begin(), c.end(), [&](std::uint32_t p) { return surface.input_point[p] != 0; });
      is_whole[source] = count[source] == 0 && is_given ? 1 : 0;
      ++count[source];
    }
  }
};

void note_fates(std::size_t triangles, const Surface& before, const Surface& after,
                RepairReport& report) {
  const Pieces had(triangles, before), has(triangles, after);
  report.triangles = {};
  for (std::size_t t = 0; t < triangles; ++t) {
    if (has.count[t] > 0)
      ++(has.is_whole[t] != 0 ? report.triangles.untouched : report.triangles.cut);
    if (had.count[t] == 0 || has.count[t] > 0) continue;
    if (report.parts.bounding_triangles > 0) --report.parts.bounding_triangles;
    ++report.parts.inside_triangles;
  }
  report.parts.places.clear();
}

}  // namespace

Surface seal_solid(const TriangleSoup& soup, Surface solid, const RepairOptions& options,
                   const RepairAgain& repair_again, RepairReport& report) {
  std::unique_ptr<ClosedOpenings> sealed;
  {
    StageMeter meter(report.stages, options.progress);
    meter.begin("seal");
    sealed = close_openings(solid, options.seal, report.seal, options.progress);
  }
  if (!sealed) return solid;
  RepairReport second;
  Surface surface = surface_of(*sealed, options, repair_again, second);
  append_report(std::move(second), report);
  note_fates(soup.triangles.size(), solid, surface, report);
  describe_output(surface, report);
  return surface;
}

}  // namespace meshrepair::internal
