// SPDX-License-Identifier: MIT
// --explain: what was read and what was made of it beside each other, each triangle in the colour
// of what became of it, or of where it comes from.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <mesh/coloured_ply.h>
#include <mesh/scene.h>
#include <mesh/soup.h>

#include "options/command_line.h"
#include "options/show_requests.h"
#include "program/program.h"
#include "report/findings.h"

namespace meshrepair {

// What a triangle can be, with the colour that says so.
struct TriangleKind {
  std::string_view name;  // as in the report
  std::string_view meaning;
  Colour colour;
};
// In the order of TriangleFate, and of TriangleOrigin.
[[nodiscard]] std::vector<TriangleKind> kinds_of_fates();
[[nodiscard]] std::vector<TriangleKind> kinds_of_origins();

// The help names the colours.
void add_explain_option(CommandLine& app, std::string& path);

// Before hours of work, as check_files(): throws UsageError where the file is no PLY or GLB, or
// another one of the run, OutputError where it cannot be written. An empty path asks for nothing.
void check_explanation(const std::string& path, const std::vector<std::string>& files, Run& run);

struct ExplainedMesh {
  const TriangleSoup& soup;  // as RepairReport::explanation has it
  const Scene& scene;        // whose meshes it is made of; without meshes: as it is
};

// Stage "explain", where it is asked for. Of `findings` it takes what became of the triangles.
void write_explanation_stage(const std::string& path, const ExplainedMesh& input,
                             const ExplainedMesh& result, Run& run, Findings& findings);

// What a picture of IN and OUT is drawn with where it is to have these colours; else nothing.
[[nodiscard]] std::array<Attributes, 2> painted_fates(const PictureRequest& request,
                                                      const Findings& findings);

// For the summary; empty where nothing was explained.
[[nodiscard]] std::vector<std::string> explanation_lines(const Findings& findings);

}  // namespace meshrepair
