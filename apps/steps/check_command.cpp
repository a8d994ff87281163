// SPDX-License-Identifier: MIT
#include "steps/check_command.h"

#include <algorithm>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <spdlog/fmt/fmt.h>

#include <base/atomic_file.h>
#include <base/error.h>
#include <check/check_surface.h>

#include "options/file_kinds.h"
#include "page/html_report.h"
#include "page/scene_page.h"
#include "pictures/picture_steps.h"
#include "program/command_files.h"
#include "report/attribute_report.h"
#include "report/check_report.h"
#include "report/findings.h"
#include "report/words.h"
#include "steps/mesh_steps.h"
#include "steps/run_steps.h"

namespace meshrepair {
namespace {

void write_marked(const TriangleSoup& soup, const std::vector<Colour>& colours,
                  const CheckCommand& options, Run& run) {
  std::vector<std::string> comments;
  for (const std::string& line : colour_legend()) comments.push_back(line);
  const std::string ply = format_coloured_ply(soup, colours, comments);
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

// What is found of the soup, or of the meshes in it.
struct Verdict {
  bool is_valid = true;
  std::vector<Colour> colours;  // if they are asked for
  std::string table;
  SurfaceCheck check;              // if a page is asked for
  std::optional<ThinReport> thin;  // likewise, and what is thin, too
};

Verdict check_one(const ReadResult& input, const CheckCommand& options, Run& run,
                  const Findings& findings) {
  CheckOptions request = options.request.check;
  if (options.html.wanted()) request.most_places = std::max(request.most_places, kMostPagePlaces);
  SurfaceCheck check = check_surface(input.soup, request);
  SurfaceCheck kept;
  if (options.html.wanted()) kept = check;
  keep_places(check, options.request.check.most_places);
  Json section = check_section(check);
  std::string more = add_openings(input.soup, check, options.request, section) +
                     add_near_faces(input.soup, options.request, section);
  ThinFound thin = add_thin_places(input.soup, check, options.request,
                                   options.html.wanted() ? kMostPagePlaces : 0, section);
  more += thin.text;
  run.report.set_section("check", std::move(section));
  return {check.valid_solid(), defect_colours(check, thin.marks()),
          check_table(check, what_was_read(findings, input.soup),
                      attribute_words(input.soup, input.attributes), findings.unit) +
              more,
          std::move(kept), std::move(thin.report)};
}

// A line for each mesh, and a table for one that is no solid.
Verdict check_each(const ReadResult& input, const CheckCommand& options, Run& run,
                   const Findings& findings) {
  Verdict all;
  Json sections = Json::array();
  std::vector<TriangleSoup> meshes = meshes_of(input.soup, input.scene);
  std::size_t solids = 0;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const SurfaceCheck check = check_surface(meshes[m], options.request.check);
    const std::string name = mesh_name(input.scene, m);
    solids += check.valid_solid() ? 1 : 0;
    Json section = check_section(check);
    std::string more = add_openings(meshes[m], check, options.request, section) +
                       add_near_faces(meshes[m], options.request, section);
    const ThinFound thin = add_thin_places(meshes[m], check, options.request, 0, section);
    more += thin.text;
    sections.push_back({{"name", name}, {"check", std::move(section)}});
    const std::vector<Colour> colours = defect_colours(check, thin.marks());
    all.colours.insert(all.colours.end(), colours.begin(), colours.end());
    const std::string what =
        fmt::format("{}: {}, {}", name, number_of(meshes[m].triangles.size(), "triangle"),
                    number_of(meshes[m].points.size(), "point"));
    all.table += check.valid_solid() ? what + ", a valid solid\n"
                                     : check_table(check, what, {}, findings.unit);
    all.table += more;
  }
  run.report.set_section("meshes", std::move(sections));
  all.is_valid = solids == meshes.size();
  all.table += fmt::format("{}: {}, {} of them valid solids\n", findings.input_name(),
                           number_of(meshes.size(), "mesh", "meshes"), grouped(solids));
  return all;
}

// Takes what is for the page out of the verdict.
void write_page_stage(const ReadResult& input, Verdict& verdict, const CheckCommand& options,
                      Run& run, Findings& findings) {
  if (options.assets.by_mesh) {
    const ScenePage page = {
        up_of(findings), {input.soup, input.attributes, input.scene}, {}, options.request.check};
    return write_scene_page_stage(options.html, page, run, findings);
  }
  ShownMesh mesh{"input", {}, input.soup, std::move(verdict.check)};
  mesh.thin = std::move(verdict.thin);
  mesh.attributes = &input.attributes;
  write_html_stage(options.html, up_of(findings), std::move(mesh),
                   options.request.check.most_places, run, findings);
}

std::string mark_help() {
  std::string text = "Write the mesh as PLY, each triangle coloured by its worst defect:";
  for (const std::string& line : colour_legend()) text += "\n  " + line;
  return text;
}

}  // namespace

void add_check_command(CommandLine& app, CheckCommand& command) {
  add_check_options(app, command.request);
  add_scene_option(app, command.assets, "Check");
  app.add_option("--mark", command.marked, mark_help())
      ->check(names_side_file(".ply"))
      ->type_name("FILE")
      ->group("Output");
  add_picture_options(app, command.picture, "IN");
  add_colours_option(app, command.picture, "defects", "those of --mark");
  add_show_options(app, command.picture, "IN");
  add_html_options(app, command.html, "IN with all defects");
}

ExitCode check_file(CheckCommand& command, Run& run) {
  if (command.marked == "-") throw UsageError("--mark: needs the name of a file");
  if (!command.marked.empty() && is_same_file(command.marked, command.input)) {
    throw UsageError("--mark: " + command.marked + " is the input, too");
  }
  check_files(command.input, command.marked, run);
  check_picture(command.picture, {command.input, command.marked}, run);
  check_html(command.html, {command.input, command.marked, command.picture.path}, run);
  command.request.check.progress = &run.progress;
  command.request.check.mark_triangles =
      !command.marked.empty() || command.html.wanted() || command.picture.painted;
  Findings findings(command.input, command.marked);
  return with_findings(run, findings, [&] {
    ReadOptions reading = read_options(run);
    reading.attributes = true;
    reading.by_mesh = command.assets.by_mesh;
    ReadResult input = read_mesh_stage(reading, run, findings);
    check_picture(command.picture, input.attributes);
    run.report.set_section("attributes", attributes_section(input.soup, input.attributes));
    StageMeter meter(findings.repair.stages, nullptr);  // the check tells of its own stages
    meter.begin("check");
    Verdict verdict = command.assets.by_mesh ? check_each(input, command, run, findings)
                                             : check_one(input, command, run, findings);
    meter.end();
    if (!command.marked.empty()) write_marked(input.soup, verdict.colours, command, run);
    write_page_stage(input, verdict, command, run, findings);
    if (command.picture.painted) input.attributes = painted(verdict.colours);
    place_instances(input.soup, input.attributes, input.scene);
    draw_picture_stage(command.picture, up_of(findings), {command.input},
                       {{input.soup, input.attributes}}, run, findings);
    run.progress.finish();
    print_summary(findings.shown);
    if (run.options.report != "-" && !run.options.quiet) std::cout << verdict.table;
    return verdict.is_valid ? ExitCode::done : ExitCode::not_certified;
  });
}

}  // namespace meshrepair
