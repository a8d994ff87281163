// SPDX-License-Identifier: MIT
// What meshrepair is asked for, and how it is done: from file to file, and in memory.
#pragma once

#include <check/thin_places.h>
#include <extract/surface.h>
#include <mesh/attributes.h>

#include "options/command_line.h"
#include "program/program.h"
#include "report/findings.h"
#include "steps/hollow_steps.h"
#include "steps/offset_steps.h"
#include "steps/point_steps.h"
#include "steps/step_options.h"

namespace meshrepair {

struct RepairCommand {
  StepOptions steps;
  PointOptions points;
  OffsetRequest offset;
  HollowRequest hollow;
  ThinOptions thin;  // what is thinner in the result is told; nothing if its limit is 0
  NegativeVolumes negative = NegativeVolumes::subtract;
  bool always = false;  // do the whole work, also for what is a solid already
};

// All options of meshrepair; IN and OUT, and those of every program, are for the caller to add.
void add_repair_command(CommandLine& app, RepairCommand& command);

// Reads command.steps.input, repairs it and writes command.steps.output: the body of run_steps().
void repair_file(const RepairCommand& command, Run& run, Findings& findings);

struct RepairedMesh {
  Surface surface;
  Attributes attributes;  // of its triangles
};

// The same for what is there already, and stays there: the mesh that repair_file() would write
// where command.steps.format is that of OUT; without it, in a file that holds all that memory
// holds. Of points, `input` gets the soup that was repaired. Fills findings.missing_guarantees.
[[nodiscard]] RepairedMesh repair_in_memory(AnySoup& input, const RepairCommand& command, Run& run,
                                            Findings& findings);

}  // namespace meshrepair
