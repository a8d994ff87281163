// SPDX-License-Identifier: MIT
// --html: what was wrong with a mesh, and what became of it, as a page for browsers.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <picture/view.h>

#include "options/command_line.h"
#include "options/show_requests.h"
#include "page/mesh_facts.h"
#include "pictures/picture_steps.h"
#include "program/program.h"
#include "report/findings.h"
#include "report/json_report.h"

namespace meshrepair {

// --html and --html-triangles. `what` is shown: "IN and OUT".
void add_html_options(CommandLine& app, HtmlRequest& request, const std::string& what);

// Before hours of work, as check_files(): throws UsageError where the page is another file of the
// run; OutputError where it cannot be written.
void check_html(const HtmlRequest& request, const std::vector<std::string>& files, Run& run);

// Of each defect in the report, unless more are asked for.
inline constexpr std::size_t kPlacesInReport = 10;

struct PageContent {
  std::string_view subject;  // "repair", "check", "boolean" or "distance": words of the viewer
  View::Up up = View::Up::z;
  std::optional<LengthUnit> unit;
  std::vector<ShownMesh> meshes = {};    // one, two, or pairs to choose from
  std::vector<std::string> inputs = {};  // files of meshes, in whose folders pictures may be
  std::size_t places = kPlacesInReport;  // of each defect in the section of the report
  Json more = Json::object();            // what such a page has besides
  Json report = Json::object();          // its raw numbers, none of which depends on the clock
};

// The last part of a name, or `otherwise` where it is "-".
[[nodiscard]] std::string page_name(const std::string& path, const std::string& otherwise);
// With what a page needs beside these options.
[[nodiscard]] SurfaceCheck check_for_page(const TriangleSoup& soup, Run& run,
                                          CheckOptions options = {});
// Around all of them.
[[nodiscard]] PageGrid grid_of(const std::vector<ShownMesh>& meshes);
// The sections of the report, none of which says how long anything took.
[[nodiscard]] Json page_sections(const Findings& findings);
// Of each triangle, for ShownMesh::kind_of.
template <class Kind>
[[nodiscard]] std::vector<std::uint32_t> numbers_of(const std::vector<Kind>& kinds) {
  std::vector<std::uint32_t> numbers;
  numbers.reserve(kinds.size());
  for (const Kind kind : kinds) numbers.push_back(static_cast<std::uint32_t>(kind));
  return numbers;
}
// Writes the page, and the section "html" of the report.
void write_page(const HtmlRequest& request, PageContent content, Run& run);

// Stage "html", where it is asked for. Each mesh is checked. Of `findings` it takes what became of
// the triangles.
void write_html_stage(const HtmlRequest& request, View::Up up, const Drawn& input,
                      const Drawn& result, Run& run, Findings& findings);

// The same of one mesh, which is checked already; its section "check" is in the report.
void write_html_stage(const HtmlRequest& request, View::Up up, ShownMesh mesh, std::size_t places,
                      Run& run, Findings& findings);

}  // namespace meshrepair
