// meshcheck IN: what is wrong with a mesh, and whether it is the boundary of a solid.
#include <iostream>
#include <string>

#include <spdlog/fmt/fmt.h>

#include <base/atomic_file.h>
#include <base/error.h>
#include <check/check_surface.h>

#include "common/attribute_report.h"
#include "common/check_report.h"
#include "common/repair_steps.h"
#include "common/summary.h"

namespace meshrepair {
namespace {

struct Options {
  std::string input;
  std::string marked;  // empty: no such file
  bool json = false;
  CheckOptions check;
};

void write_marked(const TriangleSoup& soup, const SurfaceCheck& check, const Options& options,
                  Run& run) {
  std::vector<std::string> comments;
  for (const std::string& line : colour_legend()) comments.push_back(line);
  const std::string ply = format_coloured_ply(soup, defect_colours(check), comments);
  const Packing packing = packing_of_extension(options.marked);
  write_file_atomically(options.marked,
                        packing == Packing::none ? ply : pack_bytes(ply, packing, &run.progress));
  run.report.set_output({{"path", options.marked}, {"format", "coloured PLY"}});
}

std::string what_was_read(const Findings& findings, const TriangleSoup& soup) {
  return fmt::format(
      "{}: {}, {}, {}", findings.input_name(),
      format_words(format_name(findings.mesh_read->format), findings.mesh_read->packed),
      number_of(soup.triangles.size(), "triangle"), number_of(soup.points.size(), "point"));
}

ExitCode check_mesh(Options& options, Run& run) {
  if (options.marked == "-") throw UsageError("--mark: needs the name of a file");
  if (!options.marked.empty() && is_same_file(options.marked, options.input)) {
    throw UsageError("--mark: " + options.marked + " is the input, too");
  }
  check_files(options.input, options.marked, run);
  options.check.progress = &run.progress;
  options.check.mark_triangles = !options.marked.empty();
  Findings findings(options.input, options.marked);
  return with_findings(run, findings, [&] {
    Attributes attributes;
    const TriangleSoup soup = read_mesh_stage(run, findings, false, &attributes);
    run.report.set_section("attributes", attributes_section(soup, attributes));
    StageMeter meter(findings.repair.stages, nullptr);  // the check tells of its own stages
    meter.begin("check");
    const SurfaceCheck check = check_surface(soup, options.check);
    meter.end();
    run.report.set_section("check", check_section(check));
    if (!options.marked.empty()) write_marked(soup, check, options, run);
    run.progress.finish();
    if (run.options.report != "-" && !run.options.quiet) {
      std::cout << check_table(check, what_was_read(findings, soup),
                               attribute_words(soup, attributes));
    }
    return check.valid_solid() ? ExitCode::done : ExitCode::not_certified;
  });
}

std::string mark_help() {
  std::string text = "Write the mesh as PLY, each triangle coloured by its worst defect:";
  for (const std::string& line : colour_legend()) text += "\n  " + line;
  return text;
}

}  // namespace
}  // namespace meshrepair

int main(int argc, char** argv) {
  using namespace meshrepair;
  Options options;
  Program program(
      "meshcheck",
      "Says what is wrong with a mesh. Exit code 0: it is the boundary of a solid, 1: it "
      "is not.",
      "  meshcheck part.stl\n"
      "  meshcheck part.obj --mark defects.ply\n"
      "  meshcheck part.obj --json | jq .check.defects.open_edges.count\n");
  CLI::App& app = program.command_line();
  app.add_option("IN", options.input,
                 "Mesh to check: STL, OBJ, OFF, PLY, glTF or 3MF, maybe packed (.gz, .zst, .zip);\n"
                 "- is standard input")
      ->required();
  app.add_flag("--weld", options.check.weld,
               "Treat points with equal coordinates as one, as always in STL")
      ->group("Check");
  app.add_option("--places", options.check.most_places, "List this many places of each defect")
      ->type_name("N")
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str()
      ->group("Check");
  app.add_option("--mark", options.marked, mark_help())->type_name("FILE")->group("Output");
  app.add_flag("--json", options.json, "Print the report instead of the table: --report -")
      ->group("Output");
  return program.run(argc, argv, [&](Run& run) {
    if (options.json) program.report_to_standard_output();
    return check_mesh(options, run);
  });
}
