// SPDX-License-Identifier: MIT
#include "steps/offset_steps.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include <check/mesh_distance.h>
#include <hollow/offset.h>
#include <repair/explain_repair.h>

#include "options/numbers.h"
#include "report/words.h"
#include "terminal/warning_log.h"

namespace meshrepair {
namespace {

// A length with a sign before it.
std::optional<std::pair<double, bool>> signed_length_in(std::string_view word) {
  const bool is_inward = word.starts_with('-');
  if (is_inward) word.remove_prefix(1);
  auto length = length_in(word);
  if (length && is_inward) length->first = -length->first;
  return length;
}

void warn_of_offset(const Findings& findings, bool had_attributes) {
  if (findings.offset.unproven > 0) {
    warn(findings.input_name(),
         {WarningCode::not_hollowed,
          fmt::format("the distance of the offset surface is not proven in {}",
                      number_of(findings.offset.unproven, "place")),
          {}});
  }
  if (!had_attributes) return;
  warn(findings.input_name(), {WarningCode::attributes_lost,
                               "an offset surface has no textures, colours, materials or names",
                               {}});
}

// No triangle is whole any more.
void forget_fates(const Surface& surface, RepairExplanation& explanation) {
  if (explanation.origins.empty()) return;
  explanation.origins.assign(surface.mesh.triangles.size(), TriangleOrigin::wall);
  std::replace(explanation.fates.begin(), explanation.fates.end(), TriangleFate::whole,
               TriangleFate::cut);
}

}  // namespace

void add_offset_option(CommandLine& app, OffsetRequest& request) {
  app.add_option_function(
         "--offset",
         [&request](const std::string& word) {
           std::tie(request.distance, request.is_share) = *signed_length_in(word);
         },
         "Move the surface of the repaired solid outward by this distance, or inward if it is\n"
         "negative: in units of IN, or as a percentage of the bounding box diagonal, such as 2%.\n"
         "The distance is proven within 2 %")
      ->check([](const std::string& word) {
        return signed_length_in(word) ? std::string()
                                      : word +
                                            " is no distance: a number other than 0, or one "
                                            "with % behind it";
      })
      ->type_name("X|X%")
      ->group("Repair");
}

void offset_stage(const OffsetRequest& request, double scale, const RepairOptions& options,
                  Attributes& of_input, Surface& surface, Run& run, Findings& findings) {
  if (request.distance == 0) return;
  RepairOptions quiet = options;
  quiet.progress = &run.progress;
  const double unit = request.is_share ? bounding_diagonal(surface.mesh) : scale;
  OffsetReport made;
  surface = offset(surface, unit * request.distance, quiet, made, findings.repair);
  findings.offset = made;  // of one that was stopped, nothing is told
  forget_fates(surface, findings.repair.explanation);
  warn_of_offset(findings, !of_input.is_bare());
  of_input = {};
}

}  // namespace meshrepair
