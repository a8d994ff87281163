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
#include <repair/explain_repair.h>

#include "again/second_repair.h"
#include "arrange/chamber_surface.h"
#include "closed_openings.h"
#include "report/describe_result.h"
#include "surface/make_surface.h"

namespace meshrepair::internal {
namespace {

struct Sealed {
  Surface surface;
  std::vector<char> is_patch;  // of its triangles: over an opening
};

// Pre: what became of the second soup has not been referred to the first yet.
std::vector<char> patches_of(const SecondSoup& second, const Surface& surface) {
  std::vector<char> is_patch;
  for (const std::uint32_t source : surface.source) {
    is_patch.push_back(source != Surface::kNoSource && source >= second.first_added ? 1 : 0);
  }
  return is_patch;
}

// Nothing if it is to be certified and is not.
std::optional<Sealed> extract_sealed(const ClosedOpenings& sealed, const RepairOptions& options,
                                     RepairReport& report) {
  StageMeter meter(report.stages, options.progress);
  meter.begin("extract");
  std::optional<Surface> surface =
      boundary_of_chambers(sealed.soup, *sealed.arrangement, sealed.filled.solid, options, report);
  if (!surface) return std::nullopt;
  surface = finish_surface(sealed.soup, std::move(*surface), options, report, meter);
  if (options.certify.wanted && !report.certify.passed()) return std::nullopt;
  std::vector<char> is_patch = patches_of(sealed.second, *surface);
  refer_to_first(sealed.second, *surface);
  return Sealed{std::move(*surface), std::move(is_patch)};
}

// Certified, where need be by repairing it once more.
Sealed solid_of(const ClosedOpenings& sealed, const RepairOptions& options,
                const RepairAgain& repair_again, RepairReport& report) {
  RepairOptions second = options_for_second(sealed.second, options);
  std::optional<Sealed> solid = extract_sealed(sealed, second, report);
  if (solid) return std::move(*solid);
  second.certify.wanted = false;
  second.slit_steps = 0;
  second.simplify = 0;
  second.extract.may_touch_itself = true;
  report = {};
  solid = extract_sealed(sealed, second, report);
  if (!solid) throw InternalError("openings are sealed, but what is solid then has no boundary");
  const SecondSoup third(solid->surface);
  report = {};
  Surface repaired = repair_again(third.soup, options_for_second(third, options), report);
  std::vector<char> is_patch;
  for (const std::uint32_t source : repaired.source) {
    is_patch.push_back(source == Surface::kNoSource ? char{0} : solid->is_patch[source]);
  }
  refer_to_first(third, repaired);
  return {std::move(repaired), std::move(is_patch)};
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

void explain_seals(const TriangleSoup& soup, const Surface& before, const Sealed& after,
                   RepairExplanation& explanation) {
  const std::size_t triangles = soup.triangles.size();
  const Pieces had(triangles, before), has(triangles, after.surface);
  for (std::size_t t = 0; t < triangles; ++t) {
    if (had.count[t] == 0 || explanation.fates[t] == TriangleFate::thickened) continue;
    if (has.count[t] == 0) {
      explanation.fates[t] = TriangleFate::inside;
    } else if (explanation.fates[t] == TriangleFate::whole && has.is_whole[t] == 0) {
      explanation.fates[t] = TriangleFate::cut;
    }
  }
  explanation.origins = find_origins(soup, explanation.fates, after.surface);
  for (std::size_t t = 0; t < after.is_patch.size(); ++t) {
    if (after.is_patch[t] != 0) explanation.origins[t] = TriangleOrigin::seal;
  }
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
  Sealed result = solid_of(*sealed, options, repair_again, second);
  append_report(std::move(second), report);
  note_fates(soup.triangles.size(), solid, result.surface, report);
  if (options.explain) explain_seals(soup, solid, result, report.explanation);
  describe_output(result.surface, report);
  return std::move(result.surface);
}

}  // namespace meshrepair::internal
