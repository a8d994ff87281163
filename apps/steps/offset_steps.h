// SPDX-License-Identifier: MIT
// --offset: the surface of what was repaired, moved outward or inward.
#pragma once

#include <extract/surface.h>
#include <mesh/attributes.h>
#include <repair/repair_options.h>

#include "options/command_line.h"
#include "program/program.h"
#include "report/findings.h"

namespace meshrepair {

struct OffsetRequest {
  double distance = 0;    // 0: nothing is asked for
  bool is_share = false;  // it is one of the bounding box diagonal
};

void add_offset_option(CommandLine& app, OffsetRequest& request);

// Nothing is done unless it is asked for. The new surface takes no attributes of the input: they
// are dropped. A distance in units of IN is multiplied by `scale`. `options` are those of the
// repair. Throws UsageError where these reduce the surface.
void offset_stage(const OffsetRequest& request, double scale, const RepairOptions& options,
                  Attributes& of_input, Surface& surface, Run& run, Findings& findings);

}  // namespace meshrepair
