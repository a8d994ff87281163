#include "page/html_report.h"

#include <filesystem>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include <base/atomic_file.h>
#include <base/error.h>
#include <check/check_surface.h>

#include "common/check_report.h"
#include "common/file_kinds.h"
#include "common/numbers.h"
#include "common/report_sections.h"
#include "common/side_file.h"
#include "common/summary.h"
#include "page/html_page.h"

namespace meshrepair {
namespace {

constexpr std::size_t kPlacesInReport = 10;  // of each defect

std::string name_of(const std::string& path, const std::string& otherwise) {
  return path == "-" ? otherwise : std::filesystem::path(path).filename().string();
}

bool is_html_name(const std::string& name) {
  const std::string extension = lower_extension(name);
  return extension == ".html" || extension == ".htm";
}

SurfaceCheck checked(const TriangleSoup& soup, Run& run) {
  CheckOptions options;
  options.most_places = kMostPagePlaces;
  options.mark_triangles = true;
  options.progress = &run.progress;
  return check_surface(soup, options);
}

template <class Kind>
std::vector<std::uint32_t> numbers_of(const std::vector<Kind>& kinds) {
  std::vector<std::uint32_t> numbers;
  numbers.reserve(kinds.size());
  for (const Kind kind : kinds) numbers.push_back(static_cast<std::uint32_t>(kind));
  return numbers;
}

// The sections of the report, none of which says how long anything took.
Json sections_of(const Findings& findings) {
  JsonReport report("", {});
  add_sections(findings, report);
  return report.take_sections();
}

void write_page(const HtmlRequest& request, View::Up up, std::vector<ShownMesh> meshes,
                std::size_t places, Run& run, const Findings& findings) {
  std::vector<const TriangleSoup*> soups;
  soups.reserve(meshes.size());
  for (const ShownMesh& mesh : meshes) soups.push_back(&mesh.soup);
  const PageGrid grid = grid_of(soups);
  Json section = {{"path", request.path}};
  Json facts = Json::array();
  std::vector<std::string> packed;
  for (ShownMesh& mesh : meshes) {
    const std::vector<std::uint32_t> chosen =
        choose_triangles(mesh.soup, mesh.check.marks, request.most_triangles);
    packed.push_back(
        pack_mesh(mesh.soup, chosen, mesh.kind_of, mesh.check.marks, grid, &run.progress));
    SurfaceCheck few = mesh.check;
    keep_places(few, places);
    const Json check = check_section(few);
    section[std::string(mesh.role)] = {{"triangles_shown", chosen.size()}, {"check", check}};
    facts.push_back(facts_of(mesh, check, chosen.size(), grid));
  }
  const Json page = {{"program", "meshrepair"},
                     {"version", program_version()},
                     {"up", up == View::Up::y ? "y" : "z"},
                     {"units", units_text(findings.unit)},
                     {"grid",
                      {{"bits", PageGrid::kBits},
                       {"low", {grid.low.x(), grid.low.y(), grid.low.z()}},
                       {"half", grid.half},
                       {"high", grid.high}}},
                     {"looks", looks_of_defects()},
                     {"meshes", std::move(facts)},
                     {"report", sections_of(findings)}};
  write_file_atomically(request.path, html_page(page, packed), &run.progress);
  run.report.set_section("html", std::move(section));
}

}  // namespace

void add_html_options(CLI::App& app, HtmlRequest& request, const std::string& what) {
  app.add_option("--html", request.path,
                 "Write a page for browsers that shows " + what +
                     ", with all that is wrong, to be\nturned and cut open")
      ->check(names_file(".html, .htm"))
      ->type_name("FILE")
      ->group("Page");
  app.add_option("--html-triangles", request.most_triangles,
                 "Draw no more triangles of a mesh: all that are at fault, and every so many of\n"
                 "the others")
      ->check(count_between(1))
      ->type_name("N")
      ->capture_default_str()
      ->group("Page");
}

void check_html(const HtmlRequest& request, bool by_mesh, const std::vector<std::string>& files,
                Run& run) {
  if (!request.wanted()) return;
  const std::string& path = request.path;
  if (!is_html_name(path)) throw UsageError("--html: " + path + " ends neither in .html nor .htm");
  if (by_mesh) throw UsageError("--html: shows a scene as one mesh, and excludes --scene each");
  check_side_file({"--html", path, "page"}, files, run);
}

void write_html_stage(const HtmlRequest& request, View::Up up, const TriangleSoup& input,
                      const TriangleSoup& result, Run& run, Findings& findings) {
  if (!request.wanted()) return;
  StageMeter meter(findings.repair.stages, nullptr);  // the check tells of its own stages
  meter.begin("html");
  const RepairExplanation& explanation = findings.repair.explanation;
  std::vector<ShownMesh> meshes;
  meshes.push_back({"input", name_of(findings.input, findings.input_name()), input,
                    checked(input, run), kinds_of_fates(), numbers_of(explanation.fates)});
  meshes.push_back({"result", name_of(findings.output, findings.output_name()), result,
                    checked(result, run), kinds_of_origins(), numbers_of(explanation.origins)});
  write_page(request, up, std::move(meshes), kPlacesInReport, run, findings);
}

void write_html_stage(const HtmlRequest& request, View::Up up, ShownMesh mesh, std::size_t places,
                      Run& run, Findings& findings) {
  if (!request.wanted()) return;
  StageMeter meter(findings.repair.stages, &run.progress);
  meter.begin("html");
  mesh.name = name_of(findings.input, findings.input_name());
  std::vector<ShownMesh> meshes;
  meshes.push_back(std::move(mesh));
  write_page(request, up, std::move(meshes), places, run, findings);
}

}  // namespace meshrepair
