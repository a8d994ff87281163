// SPDX-License-Identifier: MIT
// --html with --scene each: the meshes of a scene where they stand, each checked by itself.
#pragma once

#include <optional>

#include <check/check_surface.h>
#include <mesh/attributes.h>
#include <mesh/scene.h>
#include <mesh/soup.h>

#include "options/show_requests.h"
#include "page/html_report.h"
#include "program/program.h"
#include "report/findings.h"

namespace meshrepair {

struct SceneOnPage {
  const TriangleSoup& soup;  // each mesh once
  const Attributes& attributes;
  const Scene& scene;
};

struct ScenePage {
  View::Up up = View::Up::z;
  SceneOnPage input;
  std::optional<SceneOnPage> result = {};  // nothing: it was only checked
  CheckOptions check = {};                 // how each mesh is
};

// Stage "html", where it is asked for. Of `findings` it takes what became of the triangles, if
// there is a result.
void write_scene_page_stage(const HtmlRequest& request, const ScenePage& page, Run& run,
                            Findings& findings);

}  // namespace meshrepair
