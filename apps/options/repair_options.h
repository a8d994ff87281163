// SPDX-License-Identifier: MIT
// The options that several programs have, beyond those that every program has.
#pragma once

#include <optional>
#include <string>

#include <extract/cut_nonmanifold.h>
#include <mesh/model_volume.h>
#include <mesh/soup_io.h>
#include <repair/certify.h>
#include <repair/hole_patches.h>
#include <repair/inside_rule.h>
#include <repair/repair.h>

#include "options/command_line.h"

namespace meshrepair {

// --inside and --cavities: which parts of space are solid.
void add_inside_options(CommandLine& app, InsideOptions& inside);

// --sew: how far open edges may be apart that belong together.
void add_sew_option(CommandLine& app, SewOptions& sew);
// --join-gaps: how far faces may be apart that are to touch.
void add_join_gaps_option(CommandLine& app, JoinGapsOptions& gaps);
// --seal: openings that a ball cannot pass.
void add_seal_option(CommandLine& app, SealOptions& seal);
// --holes: how gaps are closed.
void add_holes_option(CommandLine& app, HoleOptions& holes);
// --max-hole: how large a patch may be.
const CommandOption& add_max_hole_option(CommandLine& app, HoleOptions& holes);
// --thicken and --thicken-side: open sheets become walls. With `max_hole`, the option, what it says
// decides alone which holes are closed.
void add_thicken_options(CommandLine& app, const CommandOption& max_hole, ThickenOptions& thicken);
// --keep and --min-part: which solids of the result stay.
void add_keep_options(CommandLine& app, KeepPartsOptions& keep);
// --touching: what becomes of solids that touch along an edge.
void add_touching_option(CommandLine& app, Touching& touching);

// --negative: what becomes of negative volumes of slicers' projects.
void add_negative_option(CommandLine& app, NegativeVolumes& negative);

// --triangles: how many of the result stay.
void add_triangles_option(CommandLine& app, FewerTrianglesOptions& fewer);
// --max-error: how far they may be from those of before.
void add_max_error_option(CommandLine& app, FewerTrianglesOptions& fewer);
// --simplify: how far the surface may move to have fewer triangles.
void add_simplify_option(CommandLine& app, double& simplify);

// -o: the file to write, where it does not stand beside IN.
void add_output_option(CommandLine& app, std::string& output, const std::string& type,
                       std::string_view extensions, const std::string& description);

// --format: the format of the mesh that is written, whatever its name.
void add_format_option(CommandLine& app, std::optional<SoupFormat>& format);

// --sources: write of each triangle which one of the input it lies in.
void add_sources_option(CommandLine& app, bool& sources);

// --staging: where files are until they are moved to their places; for scripts, not in the help.
void add_staging_option(CommandLine& app, std::string& folder);

// --precision and --strict: what is to be certified, and what happens when it cannot be.
void add_certify_options(CommandLine& app, CertifyOptions& certify, bool& strict);

// --predicates and --eps: who says on which side of a plane a point of the cells lies.
// `always`: the option that they need; null: none.
void add_predicates_options(CommandLine& app, RepairOptions& repair,
                            const CommandOption* always = nullptr);

}  // namespace meshrepair
