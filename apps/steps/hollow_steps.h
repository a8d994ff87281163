// SPDX-License-Identifier: MIT
// --hollow, --drain and --drain-at: cavities in what was repaired.
#pragma once

#include <string>
#include <vector>

#include <extract/surface.h>
#include <hollow/hollow_options.h>
#include <mesh/attributes.h>
#include <repair/repair_options.h>

#include "options/command_line.h"
#include "program/program.h"
#include "report/findings.h"

namespace meshrepair {

struct HollowRequest {
  HollowOptions options;
  bool is_share = false;  // options.wall is one of the bounding box diagonal
  bool is_drain_share = false;
  std::vector<std::string> places;  // of --drain-at

  // From the units and the origin of IN to those of the result.
  void scale_and_move(double factor, const Findings& findings);
};

void add_hollow_options(CommandLine& app, HollowRequest& request);

// Stage "hollow". Nothing is done unless it is asked for. The attributes are those of the surface's
// triangles, and stay with them; walls have none. `options` are those of the repair.
void hollow_stage(const HollowRequest& request, const RepairOptions& options, Surface& surface,
                  Attributes& attributes, Run& run, Findings& findings);

}  // namespace meshrepair
