// SPDX-License-Identifier: MIT
#include "steps/check_steps.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include <base/stage_meter.h>
#include <repair/join_gaps.h>
#include <repair/seal_openings.h>

#include "options/numbers.h"
#include "report/thickness_report.h"
#include "report/words.h"
#include "steps/scene_steps.h"

namespace meshrepair {

void add_check_options(CommandLine& app, CheckRequest& request) {
  app.add_flag("--weld", request.check.weld,
               "Merge points with equal coordinates, as always for STL")
      ->group("Check");
  app.add_option("--places", request.check.most_places, "List this many locations of each defect")
      ->type_name("N")
      ->check(count_between(0, 1'000'000))
      ->capture_default_str()
      ->group("Check");
  app.add_flag(
         "--openings", request.openings,
         "Look for narrow openings of much wider spaces, and print the volume that the solid\n"
         "encloses once they are closed (by meshrepair --seal)")
      ->group("Check");
  add_length_option(
      app, "--thickness", request.thin.limit, request.thin.is_share,
      "Look for walls, pins, gaps and sharp edges that are thinner than this, in units of\n"
      "IN, or as a percentage of the bounding box diagonal, such as 1%, and print where",
      "Check");
}

std::string add_openings(const TriangleSoup& soup, const SurfaceCheck& check,
                         const CheckRequest& request, Json& section) {
  if (!request.openings) return {};
  section["openings"] = nullptr;
  if (!check.valid_solid()) return "openings  are looked for in valid solids\n";
  const SealReport seal =
      propose_seal(as_given(soup), SealOptions().most_cubes, request.check.progress);
  const double volume = check.volume + seal.filled_volume;
  section["openings"] = {{"count", seal.openings},
                         {"size", seal.size},
                         {"filled_volume", seal.filled_volume},
                         {"volume", volume}};
  if (seal.openings == 0) return "openings  none: no narrow opening of a much wider space\n";
  const std::string encloses =
      std::isfinite(volume) ? fmt::format("encloses {:.6g}", volume) : "encloses more";
  return fmt::format(
      "openings  the solid {} if {} narrower than {:.4g} {} closed: meshrepair --seal {:.4g}\n",
      encloses, number_of(seal.openings, "opening"), seal.size, seal.openings == 1 ? "is" : "are",
      seal.size);
}

std::span<const std::uint8_t> ThinFound::marks() const {
  if (!report) return {};
  return report->marks;
}

ThinFound add_thin_places(const TriangleSoup& soup, const SurfaceCheck& check,
                          const CheckRequest& request, std::size_t most_kept, Json& section) {
  if (request.thin.limit <= 0) return {};
  ThinOptions options = request.thin;
  options.most_places = std::max(most_kept, request.check.most_places);
  options.mark_triangles = request.check.mark_triangles;
  options.progress = request.check.progress;
  ThinFound found{{}, find_thin_places(soup, options)};
  ThinReport few = *found.report;
  keep_places(few, request.check.most_places);
  section["thickness"] = thickness_section(few);
  found.text = thickness_text(few, check.valid_solid());
  return found;
}

void thickness_stage(const TriangleSoup& result, ThinOptions options, double scale, Run& run,
                     Findings& findings) {
  if (options.limit <= 0) return;
  if (!options.is_share) options.limit *= scale;
  options.progress = &run.progress;
  StageMeter meter(findings.repair.stages, nullptr);  // the search tells of its own stage
  meter.begin("thickness");
  findings.thin = find_thin_places(result, options);
}

std::string add_near_faces(const TriangleSoup& soup, const CheckRequest& request, Json& section) {
  CancelOnly quiet(request.check.progress);
  const GapProposal gaps = propose_gaps(soup, &quiet);
  if (gaps.pairs == 0) return {};
  section["near_faces"] = {
      {"pairs", gaps.pairs}, {"apart", gaps.widest_gap}, {"distance", gaps.distance}};
  return fmt::format("near      {} {} at most {:.3g} apart: meshrepair --join-gaps {:.2g}\n",
                     number_of(gaps.pairs, "pair of faces", "pairs of faces"),
                     gaps.pairs == 1 ? "is" : "are", gaps.widest_gap, gaps.distance);
}

}  // namespace meshrepair
