// --html: what was wrong with a mesh, and what became of it, as a page for browsers.
#pragma once

#include <string>
#include <vector>

#include <CLI/App.hpp>

#include <picture/view.h>

#include "common/repair_steps.h"
#include "page/html_request.h"
#include "page/mesh_facts.h"

namespace meshrepair {

// --html and --html-triangles. `what` is shown: "IN and OUT".
void add_html_options(CLI::App& app, HtmlRequest& request, const std::string& what);

// Before hours of work, as check_files(): throws UsageError where the page is another file of the
// run, or where meshes are taken one by one; OutputError where it cannot be written.
void check_html(const HtmlRequest& request, bool by_mesh, const std::vector<std::string>& files,
                Run& run);

// Stage "html", where it is asked for. Each mesh is checked. Of `findings` it takes what became of
// the triangles.
void write_html_stage(const HtmlRequest& request, View::Up up, const TriangleSoup& input,
                      const TriangleSoup& result, Run& run, Findings& findings);

// The same of one mesh, which is checked already; its section "check" is in the report.
void write_html_stage(const HtmlRequest& request, View::Up up, ShownMesh mesh, std::size_t places,
                      Run& run, Findings& findings);

}  // namespace meshrepair
