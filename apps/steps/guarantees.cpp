// SPDX-License-Identifier: MIT
#include "steps/guarantees.h"

#include <spdlog/logger.h>

#include "report/words.h"
#include "terminal/logging.h"
#include "terminal/warning_log.h"

namespace meshrepair {

void look_at_file(const Surface& surface, SoupFormat format, Findings& findings) {
  findings.output_points = surface.mesh.points.size();
  if (!welds_points(format)) return;
  const TriangleSoup back = as_read_back(surface.mesh, format);
  findings.output_points = back.points.size();
  findings.repair.output = examine_topology(back.triangles, back.points.size());
}

std::string missing_guarantees(const Findings& findings, SoupFormat format) {
  const Topology& surface = findings.repair.output;
  std::string missing;
  if (!surface.closed()) missing += ", not closed";
  if (!surface.manifold()) missing += ", not manifold";
  if (!surface.oriented()) missing += ", not consistently oriented";
  if (!missing.empty() && welds_points(format)) {
    missing += " once " + std::string(format_name(format)) +
               " has rounded and joined its corners (OBJ, OFF and PLY keep them)";
  }
  const CertifyReport& certified = findings.repair.certify;
  if (certified.pairs > 0) {
    missing += ", with " + number_of(certified.pairs, "pair") + " of triangles that intersect";
  }
  if (certified.degenerate > 0) {
    missing += ", with " + number_of(certified.degenerate, "triangle") + " without area";
  }
  if (certified.inside_out_parts > 0) {
    missing += ", with " + number_of(certified.inside_out_parts, "part") + " inside out";
  }
  return missing.empty() ? missing : missing.substr(2);
}

ExitCode verdict(Run& run, const Findings& findings) {
  std::vector<std::string> faults = findings.not_met;
  if (!findings.missing_guarantees.empty()) {
    faults.insert(faults.begin(),
                  (findings.withheld && findings.summary.empty() ? "it would be " : "") +
                      findings.missing_guarantees);
  }
  if (faults.empty()) return ExitCode::done;
  const std::string head =
      findings.output_name() + (findings.withheld ? ": not written, as " : ": written, but ");
  show_held_warnings();
  for (const std::string& fault : faults) logger().error("{}{}", head, fault);
  run.report.set_error("error: " + head + joined_with("; ", faults));
  return ExitCode::not_certified;
}

}  // namespace meshrepair
