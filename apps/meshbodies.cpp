// SPDX-License-Identifier: MIT
// meshbodies A B ... -o OUT: bodies with common faces.
#include <filesystem>
#include <fmt/format.h>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <base/atomic_file.h>
#include <base/error.h>
#include <boolean/bodies.h>
#include <mesh/packing.h>
#include <mesh/region_mesh.h>

#include "options/choice_option.h"
#include "options/file_kinds.h"
#include "options/repair_options.h"
#include "program/command_files.h"
#include "program/program.h"
#include "report/findings.h"
#include "report/words.h"
#include "steps/bodies_steps.h"
#include "steps/common_unit.h"
#include "steps/guarantees.h"
#include "steps/mesh_steps.h"
#include "steps/origin_steps.h"
#include "steps/run_steps.h"
#include "summary/summary.h"
#include "terminal/logging.h"
#include "terminal/warning_log.h"

namespace meshrepair {
namespace {

constexpr std::string_view kPlaceOfName = "{}";  // in the name of the output

bool has_place_of_name(const std::string& output) {
  return output.find(kPlaceOfName) != std::string::npos;
}

// "a" for "folder/a.stl.gz".
std::string stem_of(const std::string& path, const std::string& otherwise) {
  if (path == "-") return otherwise;
  return std::filesystem::path(without_packing(path)).stem().string();
}

// What all files have in common.
struct Intake {
  CommonUnit unit;
  CommonOrigin origin;
  Bodies bodies;
  Json facts = Json::array();
};

// The bodies of a file: all of it if there are several files, else what its triangles are named.
void take_file(const BodiesCommand& command, const std::string& name, Run& run, Intake& intake) {
  Findings findings(name, "");
  std::vector<NamedSoup> given;
  (void)with_findings(run, findings, [&] {
    ReadOptions reading = read_options(run);
    reading.may_be_empty = true;
    reading.attributes = command.inputs.size() == 1;
    auto [soup, attributes, scene, report, placed] = read_mesh_stage(reading, run, findings);
    const double scale = intake.unit.apply(findings.unit, soup);
    if (report.offset) *report.offset *= scale;
    intake.origin.apply(report.offset, soup, findings);
    const std::string stem = stem_of(name, findings.input_name());
    given = command.inputs.size() == 1 ? named_bodies(std::move(soup), attributes, command.by, stem)
                                       : std::vector<NamedSoup>{{stem, std::move(soup)}};
    return ExitCode::done;
  });
  for (NamedSoup& body : given) {
    intake.bodies.add(std::move(body), command, run, findings, intake.facts);
  }
}

// What "{}" stands for in the name of a region's file: nothing that leads elsewhere.
std::string in_file_name(std::string name) {
  for (char& c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < ' ' || std::string_view("/\\:*?\"<>|").find(c) != std::string_view::npos) c = '_';
  }
  return name;
}

// Of each region that has faces, its file; all differ, and none is an input, or the report.
std::vector<std::string> files_of(const BodiesCommand& command, const ConformingBodies& result,
                                  const Bodies& bodies, Run& run) {
  std::vector<std::string> files(result.regions.size());
  std::set<std::string> taken;
  for (std::uint32_t r = 1; r <= files.size(); ++r) {
    if (result.regions[r - 1].triangles == 0) continue;
    const std::string name = in_file_name(bodies.name_of(r));
    std::string unique = name;
    for (int n = 2; !taken.insert(unique).second; ++n) unique = name + "-" + std::to_string(n);
    files[r - 1] = command.output;
    for (std::size_t at = 0; (at = files[r - 1].find(kPlaceOfName, at)) != std::string::npos;) {
      files[r - 1].replace(at, kPlaceOfName.size(), unique);
      at += unique.size();
    }
    check_side_file({"--output", files[r - 1], "output"}, command.inputs, run);
  }
  return files;
}

void write_each(const WriteOptions& format, const ConformingBodies& result,
                const std::vector<std::string>& files) {
  const std::vector<TriangleSoup> boundaries = boundaries_of(result);
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!files[i].empty()) write_soup(boundaries[i], files[i], format);
  }
}

// Beside a file for Gmsh.
std::filesystem::path script_of(std::filesystem::path msh) { return msh.replace_extension(".geo"); }

void write_faces(const std::filesystem::path& path, RegionFormat format, const RegionMesh& mesh,
                 const std::vector<std::string>& comments, Run& run) {
  write_file_atomically(path, format_region_mesh(mesh, format, comments), &run.progress);
  if (format != RegionFormat::msh) return;
  write_file_atomically(script_of(path), format_gmsh_script(mesh, path.filename().string()),
                        &run.progress);
}

void write_bodies(const BodiesCommand& command, const Bodies& bodies,
                  const ConformingBodies& result, WriteOptions format, BodiesFacts& facts,
                  Run& run) {
  const std::string& output = command.output;
  const auto regions = region_format_of(output);
  const bool is_each = has_place_of_name(output);
  run.report.set_output({{"path", output},
                         {"format", regions && !is_each ? region_format_name(*regions)
                                                        : format_name(*format.format)}});
  if (is_each) {
    facts.files = files_of(command, result, bodies, run);
    return write_each(format, result, facts.files);
  }
  const std::vector<std::string>& names = bodies.region_names();
  if (regions) {
    const RegionMesh mesh = {result.mesh, result.parts_of, result.region_of_part, names,
                             result.seeds};
    return write_faces(output, *regions, mesh, format.extras.comments, run);
  }
  const auto [soup, scene] = as_scene(result, names);
  format.extras.scene = &scene;
  write_soup(soup, output, format);
}

// Finds how exact the coordinates of the output are.
void check_output(BodiesCommand& command) {
  const std::string& output = command.output;
  if (output.empty()) throw UsageError("the name of the output is empty");
  if (region_format_of(output) && !has_place_of_name(output)) return;
  const auto format = format_of_extension(output);
  if (!format && region_format_of(output)) {
    throw UsageError(output + ": such a file has all regions, and no {} in its name");
  }
  if (!format) {
    throw UsageError(output +
                     ": unknown format; known are .ply, .obj, .vtp, .poly, .msh, .3mf, "
                     ".glb and .gltf, and with {} in the name all formats of meshes");
  }
  if (is_single(*format)) command.repair.certify.precision = Precision::float32;
  if (has_place_of_name(output) || has_instances(*format)) return;
  throw UsageError(
      output + ": " + std::string(format_name(*format)) +
      " holds one body; with {} in the name, each body gets a file, with its name there");
}

ExitCode divide_files(const BodiesCommand& command, Run& run) {
  check_inputs(command.inputs);
  WriteOptions format;
  format.format = format_of_extension(command.output);
  format.progress = &run.progress;
  Intake intake{CommonUnit({}), CommonOrigin({}, format.format), {}};
  for (const std::string& name : command.inputs) take_file(command, name, run, intake);
  run.report.set_section("operands", std::move(intake.facts));
  format.extras.unit = intake.unit.get();
  Findings findings(joined_with(", ", command.inputs), command.output);
  findings.origin = intake.origin.get();
  keep_origin(findings, format);
  return with_findings(run, findings, [&] {
    BodiesFacts told;
    const ConformingBodies result =
        divide_bodies(intake.bodies, command, told.report, run, findings);
    {
      StageMeter meter(findings.repair.stages, &run.progress);
      meter.begin("write");
      write_bodies(command, intake.bodies, result, format, told, run);
    }
    tell_of_bodies(intake.bodies, result, command, told, run);
    const double seconds = run.progress.seconds();
    run.progress.finish();
    show_held_warnings();
    if (!run.options.quiet) {
      print_summary(gaps_summary(findings.repair) +
                    bodies_summary(intake.bodies, result, told.report) +
                    fmt::format("written   {}: {}, in {:.2f} s\n", command.output,
                                number_of(result.mesh.triangles.size(), "triangle"), seconds));
    }
    findings.missing_guarantees = missing_guarantees(told.report);
    return verdict(run, findings);
  });
}

}  // namespace
}  // namespace meshrepair

int main(int argc, char** argv) {
  using namespace meshrepair;
  BodiesCommand command;
  Program program(
      "meshbodies",
      "Divides bodies that touch or overlap into regions with common faces, as meshers\n"
      "for simulation need them.",
      "  meshbodies body.stl drill.obj -o both.msh\n"
      "  meshbodies assembly.3mf --overlap own -o assembly.poly\n"
      "  meshbodies body.stl drill.obj --join-gaps 0.01 -o part-{}.stl\n");
  CommandLine& app = program.command_line();
  app.add_option("IN", command.inputs,
                 "Bodies, a file each; or one file whose objects, groups or materials are the\n"
                 "bodies; a mesh that is not a solid is repaired first")
      ->check(names_file(mesh_extensions()))
      ->required()
      ->repeated();
  add_output_option(
      app, command.output, "OUT", ".ply, .obj, .vtp, .poly, .msh, .3mf, .glb, .gltf",
      "File to write. Each face once, with the regions on both sides: PLY, OBJ, VTP,\n"
      "POLY (TetGen) and MSH (Gmsh). Each region a closed object: 3MF, GLB and glTF.\n"
      "With {} in the name, a file for each region");
  add_bodies_command(app, command);
  return program.run(argc, argv, [&](Run& run) {
    check_output(command);
    for (const std::string& input : command.inputs) check_files(input, command.output, run);
    if (region_format_of(command.output) == RegionFormat::msh) {
      check_side_file({"--output", script_of(command.output).string(), "script of Gmsh"},
                      command.inputs, run);
    }
    return divide_files(command, run);
  });
}
