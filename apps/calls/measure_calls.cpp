// SPDX-License-Identifier: MIT
#include "calls/measure_calls.h"

#include <utility>

#include <base/error.h>
#include <check/mesh_distance.h>

#include "report/check_report.h"
#include "report/distance_report.h"
#include "steps/check_command.h"
#include "steps/check_steps.h"

namespace meshrepair {

CheckOutcome check_call(const TriangleSoup& soup, const Keywords& keywords, const Runner& runner) {
  Session session("meshcheck");
  CheckRequest request;
  add_check_options(session.options(), request);
  session.parse(keywords, {});
  request.check.mark_triangles = true;
  CheckOutcome outcome;
  static_cast<Outcome&>(outcome) = runner(session, [&](Run& run) {
    request.check.progress = &run.progress;
    outcome.check = check_surface(soup, request.check);
    Json section = check_section(outcome.check);
    (void)add_openings(soup, outcome.check, request, section);
    (void)add_near_faces(soup, request, section);
    (void)add_thin_places(soup, outcome.check, request, 0, section);
    run.report.set_section("check", std::move(section));
    return outcome.check.valid_solid() ? ExitCode::done : ExitCode::not_certified;
  });
  return outcome;
}

Outcome check_file_call(const std::string& input, const Keywords& keywords, const Runner& runner) {
  Session session("meshcheck");
  CheckCommand command;
  add_check_command(session.options(), command);
  session.parse(keywords, {});
  if (input == "-") throw UsageError("-: is no file");
  command.input = input;
  return runner(session, [&](Run& run) { return check_file(command, run); });
}

Outcome distance_call(const TriangleSoup& first, const TriangleSoup& second,
                      const Keywords& keywords, const Runner& runner) {
  Session session("meshdist");
  DistanceOptions options;
  add_distance_options(session.options(), options);
  session.parse(keywords, {});
  return runner(session, [&](Run& run) {
    options.progress = &run.progress;
    const MeshDistance distance = mesh_distance(first, second, options);
    run.report.set_section("distance", distance_section(distance, options));
    return ExitCode::done;
  });
}

}  // namespace meshrepair
