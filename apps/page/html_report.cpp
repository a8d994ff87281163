// SPDX-License-Identifier: MIT
#include "page/html_report.h"

#include <filesystem>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include <base/atomic_file.h>
#include <base/error.h>
#include <check/check_surface.h>

#include "options/file_kinds.h"
#include "options/numbers.h"
#include "options/show_requests.h"
#include "page/html_page.h"
#include "page/pack_looks.h"
#include "page/page_pictures.h"
#include "program/command_files.h"
#include "program/program.h"
#include "report/check_report.h"
#include "report/findings.h"
#include "report/report_sections.h"
#include "report/thickness_report.h"
#include "report/words.h"
#include "terminal/warning_log.h"

namespace meshrepair {
namespace {

bool is_html_name(const std::string& name) {
  const std::string extension = lower_extension(name);
  return extension == ".html" || extension == ".htm";
}

// Makes the page of its meshes, one after the other.
class PageMaker {
 public:
  PageMaker(const HtmlRequest& request, const PageContent& content, Run& run)
      : request_(request),
        places_(content.places),
        grid_(grid_of(content.meshes)),
        run_(run),
        pictures_(content.inputs) {}

  // Packs what is drawn of it; gives its section of the report.
  Json add(ShownMesh& mesh) {
    if (!mesh.drawn) {
      mesh.drawn = drawn_mesh(mesh.soup, mesh.kind_of, page_marks(mesh), request_.most_triangles);
    }
    Json section = {{"triangles_shown", mesh.drawn->soup.triangles.size()}};
    Json check;
    if (mesh.check) {
      SurfaceCheck few = *mesh.check;
      keep_places(few, places_);
      check = check_section(few);
      if (mesh.thin) {
        has_thin_ = true;
        ThinReport thin = *mesh.thin;
        keep_places(thin, places_);
        check["thickness"] = thickness_section(thin);
      }
      section["check"] = check;
    }
    Json facts = facts_of(mesh, std::move(check), grid_);
    const std::string number = std::to_string(facts_.size());
    texts_.push_back({"mesh-" + number, pack_mesh(*mesh.drawn, grid_, &run_.progress)});
    add_looks(mesh, number, facts);
    facts_.push_back(std::move(facts));
    mesh.drawn.reset();
    return section;
  }

  [[nodiscard]] const PageGrid& grid() const { return grid_; }
  [[nodiscard]] const Json& facts() const { return facts_; }
  [[nodiscard]] bool has_thin() const { return has_thin_; }
  [[nodiscard]] const std::vector<std::string>& left_out() const { return pictures_.left_out(); }

  // Of all meshes, and the pictures that they have.
  [[nodiscard]] std::vector<PageText> texts() {
    for (std::size_t i = 0; i < pictures_.texts().size(); ++i) {
      texts_.push_back({"picture-" + std::to_string(i), pictures_.texts()[i]});
    }
    return std::move(texts_);
  }

 private:
  void add_looks(const ShownMesh& mesh, const std::string& number, Json& facts) {
    facts["looks"] = nullptr;
    if (mesh.attributes == nullptr) return;
    auto looks = pack_looks(*mesh.attributes, *mesh.drawn, pictures_, &run_.progress);
    if (!looks) return;
    facts["looks"] = std::move(looks->facts);
    texts_.push_back({"looks-" + number, std::move(looks->text)});
  }

  const HtmlRequest& request_;
  std::size_t places_;  // of each defect, in the report
  PageGrid grid_;
  Run& run_;
  PagePictures pictures_;
  Json facts_ = Json::array();
  bool has_thin_ = false;  // in a mesh
  std::vector<PageText> texts_;
};

Json json_of(const PageGrid& grid) {
  return {{"bits", PageGrid::kBits},
          {"low", {grid.low.x(), grid.low.y(), grid.low.z()}},
          {"half", grid.half},
          {"high", grid.high}};
}

}  // namespace

std::string page_name(const std::string& path, const std::string& otherwise) {
  return path == "-" ? otherwise : std::filesystem::path(path).filename().string();
}

Json page_sections(const Findings& findings) {
  JsonReport report("", {});
  add_sections(findings, report);
  return report.take_sections();
}

SurfaceCheck check_for_page(const TriangleSoup& soup, Run& run, CheckOptions options) {
  options.most_places = kMostPagePlaces;
  options.mark_triangles = true;
  options.progress = &run.progress;
  return check_surface(soup, options);
}

PageGrid grid_of(const std::vector<ShownMesh>& meshes) {
  std::vector<const TriangleSoup*> soups;
  soups.reserve(meshes.size());
  for (const ShownMesh& mesh : meshes) soups.push_back(&mesh.soup);
  return grid_of(soups);
}

void write_page(const HtmlRequest& request, PageContent content, Run& run) {
  PageMaker maker(request, content, run);
  Json section = {{"path", request.path}};
  for (ShownMesh& mesh : content.meshes) {
    Json drawn = maker.add(mesh);
    const std::string role(mesh.role);
    if (!section.contains(role)) section[role] = std::move(drawn);  // the first of several
  }
  Json page = {{"program", "meshrepair"},
               {"version", program_version()},
               {"subject", content.subject},
               {"up", content.up == View::Up::y ? "y" : "z"},
               {"units", units_text(content.unit)},
               {"grid", json_of(maker.grid())},
               {"looks", looks_of_defects(maker.has_thin())},
               {"meshes", maker.facts()},
               {"left_out", maker.left_out()}};
  page.update(content.more);
  content.report["warnings"] = warnings_section(told_warnings());
  page["report"] = std::move(content.report);
  write_file_atomically(request.path, html_page(page, maker.texts()), &run.progress);
  run.report.set_section("html", std::move(section));
}

void add_html_options(CommandLine& app, HtmlRequest& request, const std::string& what) {
  app.add_option("--html", request.path,
                 "Write an interactive HTML page that shows " + what + ",\nto turn and cut open")
      ->check(names_side_file(".html, .htm"))
      ->type_name("FILE")
      ->group("Page");
  app.add_option("--html-triangles", request.most_triangles,
                 "Draw at most this many triangles of a mesh: all defective ones, and the others\n"
                 "simplified")
      ->check(count_between(1))
      ->type_name("N")
      ->capture_default_str()
      ->group("Page");
}

void check_html(const HtmlRequest& request, const std::vector<std::string>& files, Run& run) {
  if (!request.wanted()) return;
  const std::string& path = request.path;
  if (!is_html_name(path)) throw UsageError("--html: " + path + " ends neither in .html nor .htm");
  check_side_file({"--html", path, "page"}, files, run);
}

void write_html_stage(const HtmlRequest& request, View::Up up, const Drawn& input,
                      const Drawn& result, Run& run, Findings& findings) {
  if (!request.wanted()) return;
  StageMeter meter(findings.repair.stages, nullptr);  // the check tells of its own stages
  meter.begin("html");
  const RepairExplanation& explanation = findings.repair.explanation;
  PageContent content{"repair", up, findings.unit};
  content.meshes.push_back({"input",
                            page_name(findings.input, findings.input_name()),
                            input.soup,
                            check_for_page(input.soup, run),
                            page_kinds(kinds_of_fates()),
                            numbers_of(explanation.fates),
                            {},
                            &input.attributes});
  content.meshes.push_back({"result",
                            page_name(findings.output, findings.output_name()),
                            result.soup,
                            check_for_page(result.soup, run),
                            page_kinds(kinds_of_origins()),
                            numbers_of(explanation.origins),
                            {},
                            &result.attributes,
                            {},
                            findings.thin});
  content.inputs = {findings.input};
  content.report = page_sections(findings);
  write_page(request, std::move(content), run);
}

void write_html_stage(const HtmlRequest& request, View::Up up, ShownMesh mesh, std::size_t places,
                      Run& run, Findings& findings) {
  if (!request.wanted()) return;
  StageMeter meter(findings.repair.stages, &run.progress);
  meter.begin("html");
  mesh.name = page_name(findings.input, findings.input_name());
  PageContent content{"check", up, findings.unit};
  content.meshes.push_back(std::move(mesh));
  content.inputs = {findings.input};
  content.places = places;
  content.report = page_sections(findings);
  write_page(request, std::move(content), run);
}

}  // namespace meshrepair
