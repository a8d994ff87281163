// SPDX-License-Identifier: MIT
// Reading, measuring and writing as stages of a run: messages name the file, and findings keep what
// was found.
#pragma once

#include <string>

#include <bsp/tree_io.h>
#include <mesh/soup_io.h>
#include <repair/repair.h>
#include <repair/transfer_attributes.h>

#include "program/program.h"
#include "report/findings.h"
#include "steps/step_options.h"

namespace meshrepair {

// Throws UsageError where no format can be told, or it cannot hold the sources that are asked for.
[[nodiscard]] WriteOptions mesh_format(const StepOptions& options);

// The same options, to be certified at the precision of the format.
[[nodiscard]] RepairOptions certified_for(SoupFormat format, RepairOptions options);

// As the command line limits it.
[[nodiscard]] ReadOptions read_options(Run& run);

// Stage "read". What a reader passed over is logged as warnings; its report becomes a finding.
// `options` are those of read_options(), with more.
[[nodiscard]] ReadResult read_mesh_stage(const ReadOptions& options, Run& run, Findings& findings);
// Takes over what a reader has found of a mesh.
void keep_read_report(ReadReport report, Findings& findings);
[[nodiscard]] Tree read_tree_stage(Run& run, Findings& findings);
// Stage "distance", where there will be a report to say it in. It comes before the writing, so that
// it cannot fail once there is an output. The surface is as repair() leaves it, at this precision.
void measure_distance_stage(const TriangleSoup& input, const Surface& surface, Precision precision,
                            Run& run, Findings& findings);
// Stage "attributes", where there are any: of the soup, brought onto what became of it.
[[nodiscard]] Attributes transfer_attributes_stage(const TriangleSoup& input,
                                                   const Attributes& attributes,
                                                   const Surface& surface, Run& run,
                                                   Findings& findings);
// To go behind the message of a NoSolidError: how its sheets become walls; empty where it has none.
[[nodiscard]] std::string advice_to_thicken(const RepairReport& repair);
// Warns of what a file of this format has no place for; see lost_attributes().
void warn_of_lost(const TriangleSoup& soup, const Attributes& all, const Attributes& held,
                  SoupFormat format, const Findings& findings);
// Warns where the materials of a mesh are in files beside it, but there can be none.
void write_with_files(const TriangleSoup& soup, WriteOptions format, Run& run, Findings& findings);
// Stage "write".
// Finds which guarantees the file would not hold; if options.strict and there are any, writes
// nothing. `format` is that of mesh_format(options), `attributes` those of the surface.
void write_mesh_stage(const Surface& surface, const Attributes& attributes, WriteOptions format,
                      const StepOptions& options, Run& run, Findings& findings);
// Of triangles that need be no surface.
void write_soup_stage(const TriangleSoup& soup, WriteOptions format, Run& run, Findings& findings);
void write_tree_stage(const Tree& tree, Run& run, Findings& findings);

}  // namespace meshrepair
