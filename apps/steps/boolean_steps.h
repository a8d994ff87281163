// SPDX-License-Identifier: MIT
// What bspbool is asked for, and the steps from meshes to the result: for files, and in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <boolean/boolean.h>
#include <mesh/attributes.h>
#include <mesh/soup.h>

#include "options/command_line.h"
#include "program/program.h"
#include "report/findings.h"
#include "steps/repair_command.h"
#include "steps/step_options.h"

namespace meshrepair {

struct BooleanCommand {
  std::vector<std::string> inputs;  // names of the operands, for people
  SetOperation operation = SetOperation::unite;
  bool always = false;
  StepOptions step;
};

// All options of bspbool; IN and --output, and those of every program, are for the caller to add.
void add_boolean_command(CommandLine& app, BooleanCommand& command);

// Meshes as one.
struct JoinedMeshes {
  TriangleSoup soup;
  Attributes attributes;

  void add(const TriangleSoup& other, Attributes carried);
};

struct Operand {
  TriangleSoup solid;
  Attributes attributes;              // of its triangles
  bool as_given = false;              // was the boundary of a solid already
  std::vector<std::uint32_t> source;  // of its triangles, as in Surface: of the mesh that was given
};

// For an operand: certified in double precision, as only what comes out is written.
[[nodiscard]] RepairOptions operand_options(const BooleanCommand& command, Run& run);
// The mesh if it is a solid, else what repair makes of it. A mesh of nothing is the empty solid.
[[nodiscard]] Operand make_operand(TriangleSoup soup, Attributes attributes, RepairOptions options,
                                   Run& run, Findings& findings);
// Warns of what became of it, and appends its facts and the sections of the report, which are taken
// out of that.
void end_operand(const Operand& operand, Findings& findings, Run& run, Json& facts);

// All solids, and what their triangles carry, one after the other.
struct Operands {
  std::vector<TriangleSoup> solids;
  JoinedMeshes joined;  // the triangles only where there are attributes, after join()

  void add(Operand operand);
  void join();
};

[[nodiscard]] BooleanOptions boolean_options(const BooleanCommand& command, Run& run);
// What repair says of its own grid, of the one of all operands, which have these names.
void warn_of_common_grid(const std::vector<std::string>& names,
                         const std::vector<OperandReport>& operands);
// The section "boolean" of the report, and warnings of the grid that operands share.
void tell_of_boolean(const BooleanCommand& command, const BooleanReport& report, Run& run);
// boolean(), and what is to be told of it. The result may be without triangles.
[[nodiscard]] Surface combine(const Operands& operands, const BooleanCommand& command,
                              const BooleanOptions& options, Run& run, Findings& findings);

// Meshes that are there already to the result, which stays in memory: see repair_in_memory().
// Sources count through the triangles of all meshes.
[[nodiscard]] RepairedMesh combine_in_memory(std::vector<AnySoup> meshes,
                                             const BooleanCommand& command, Run& run,
                                             Findings& findings);

}  // namespace meshrepair
