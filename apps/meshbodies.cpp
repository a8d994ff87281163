// SPDX-License-Identifier: MIT
// meshbodies A B ... -o OUT: bodies with common faces.
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <optional>
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
#include "steps/run_steps.h"
#include "summary/summary.h"
#include "terminal/logging.h"
#include "terminal/warning_log.h"

namespace meshrepair {
namespace {

constexpr std::string_view kPlaceOfName = "{}";  // in the name of the output

struct Options {
  BodiesCommand command;
  std::optional<LengthUnit> units;  // that the output is to be in, and files that say none are
};

bool has_place_of_name(const std::string& output) {
  return output.find(kPlaceOfName) != std::string::npos;
}

// "a" for "folder/a.stl.gz".
std::string stem_of(const std::string& path, const std::string& otherwise) {
  if (path == "-") return otherwise;
  return std::filesystem::path(without_packing(path)).stem().string();
}

// The bodies of a file: all of it if there are several files, else what its triangles are named.
void take_file(const Options& options, const std::string& name, Run& run, CommonUnit& unit,
               Json& facts, Bodies& bodies) {
  Findings findings(name, "");
  std::vector<NamedSoup> given;
  (void)with_findings(run, findings, [&] {
    ReadOptions reading = read_options(run);
    reading.may_be_empty = true;
    reading.attributes = options.command.inputs.size() == 1;
    auto [soup, attributes, scene, report, placed] = read_mesh_stage(reading, run, findings);
    (void)unit.apply(findings.unit, soup);
    const std::string stem = stem_of(name, findings.input_name());
    given = options.command.inputs.size() == 1
                ? named_bodies(soup, attributes, options.command.by, stem)
                : std::vector<NamedSoup>{{stem, std::move(soup)}};
    return ExitCode::done;
  });
  for (NamedSoup& body : given) bodies.add(std::move(body), options.command, run, findings, facts);
}

// What "{}" stands for in the name of a region's file: nothing that leads elsewhere.
std::string in_file_name(std::string name) {
  for (char& c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < ' ' || std::string_view("/\\:*?\"<>|").find(c) != std::string_view::npos) c = '_';
  }
  return name;
}

// Of each region that has faces, its file; all differ, and none is an input.
std::vector<std::string> files_of(const Options& options, const ConformingBodies& result,
                                  const Bodies& bodies) {
  std::vector<std::string> files(result.regions.size());
  for (std::uint32_t r = 1; r <= files.size(); ++r) {
    if (result.regions[r - 1].triangles == 0) continue;
    const std::string name = in_file_name(bodies.name_of(result, r));
    std::string file;
    for (int n = 1; n == 1 || std::find(files.begin(), files.end(), file) != files.end(); ++n) {
      file = options.command.output;
      file.replace(file.find(kPlaceOfName), kPlaceOfName.size(),
                   n == 1 ? name : name + "-" + std::to_string(n));
    }
    for (const std::string& input : options.command.inputs) {
      if (is_same_file(file, input)) throw UsageError(file + ": is an input, too");
    }
    files[r - 1] = std::move(file);
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

void write_faces(const Options& options, RegionFormat format, const ConformingBodies& result,
                 const std::vector<std::string>& names, Run& run) {
  std::vector<RegionSeed> seeds;
  for (const BodySeed& seed : result.seeds) seeds.push_back({seed.region, seed.place});
  const RegionMesh mesh = {result.mesh, result.parts_of, result.region_of_part, names, seeds};
  const std::filesystem::path path = options.command.output;
  write_file_atomically(path, format_region_mesh(mesh, format), &run.progress);
  if (format != RegionFormat::msh) return;
  std::filesystem::path script = path;
  script.replace_extension(".geo");
  write_file_atomically(script, format_gmsh_script(mesh, path.filename().string()), &run.progress);
}

void write_bodies(const Options& options, const Bodies& bodies, const ConformingBodies& result,
                  std::optional<LengthUnit> unit, BodiesFacts& facts, Run& run) {
  const std::string& output = options.command.output;
  const auto regions = region_format_of(output);
  const bool is_each = has_place_of_name(output);
  WriteOptions format;
  format.format = format_of_extension(output);
  format.extras.unit = unit;
  format.progress = &run.progress;
  run.report.set_output({{"path", output},
                         {"format", regions && !is_each ? region_format_name(*regions)
                                                        : format_name(*format.format)}});
  if (is_each) {
    facts.files = files_of(options, result, bodies);
    return write_each(format, result, facts.files);
  }
  const std::vector<std::string> names = bodies.names_of(result);
  if (regions) return write_faces(options, *regions, result, names, run);
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

ExitCode divide_files(const Options& options, Run& run) {
  check_inputs(options.command.inputs);
  Bodies bodies;
  CommonUnit unit(options.units);
  Json facts = Json::array();
  for (const std::string& name : options.command.inputs) {
    take_file(options, name, run, unit, facts, bodies);
  }
  run.report.set_section("operands", std::move(facts));
  Findings findings(joined_with(", ", options.command.inputs), options.command.output);
  return with_findings(run, findings, [&] {
    BodiesFacts told;
    const ConformingBodies result =
        divide_bodies(bodies, options.command, told.report, run, findings);
    told.files.resize(result.regions.size());
    {
      StageMeter meter(findings.repair.stages, &run.progress);
      meter.begin("write");
      write_bodies(options, bodies, result, unit.get(), told, run);
    }
    tell_of_bodies(bodies, result, options.command, told, run);
    const double seconds = run.progress.seconds();
    run.progress.finish();
    show_held_warnings();
    if (!run.options.quiet) {
      print_summary(bodies_summary(bodies, result, told.report) +
                    fmt::format("written   {}: {}, in {:.2f} s\n", options.command.output,
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
  Options options;
  Program program(
      "meshbodies",
      "Divides bodies that touch or overlap into regions with common faces, as meshers\n"
      "for simulation need them.",
      "  meshbodies body.stl drill.obj -o both.msh\n"
      "  meshbodies assembly.3mf --overlap own -o assembly.poly\n"
      "  meshbodies body.stl drill.obj --join-gaps 0.01 -o part-{}.stl\n");
  CommandLine& app = program.command_line();
  app.add_option("IN", options.command.inputs,
                 "Bodies, a file each; or one file whose objects, groups or materials are the\n"
                 "bodies; a mesh that is not a solid is repaired first")
      ->check(names_file(mesh_extensions()))
      ->required()
      ->repeated();
  add_output_option(
      app, options.command.output, "OUT", ".ply, .obj, .vtp, .poly, .msh, .3mf, .glb, .gltf",
      "File to write. Each face once, with the regions on both sides: PLY, OBJ, VTP,\n"
      "POLY (TetGen) and MSH (Gmsh). Each region a closed object: 3MF, GLB and glTF.\n"
      "With {} in the name, a file for each region");
  add_bodies_command(app, options.command);
  return program.run(argc, argv, [&](Run& run) {
    check_output(options.command);
    for (const std::string& input : options.command.inputs) {
      check_files(input, options.command.output, run);
    }
    return divide_files(options, run);
  });
}
