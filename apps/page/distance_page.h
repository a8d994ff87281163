// SPDX-License-Identifier: MIT
// --html of meshdist: how far two meshes are apart, as colours on both.
#pragma once

#include <optional>
#include <string>

#include <check/mesh_distance.h>
#include <mesh/length_unit.h>

#include "page/html_report.h"

namespace meshrepair {

struct DistancePage {
  struct Mesh {
    std::string name;  // for people
    const TriangleSoup& soup;
  };
  Mesh a, b;
  const MeshDistance& distance;
  View::Up up = View::Up::z;
  std::optional<LengthUnit> unit;
  Json report;  // the sections of the report, for the page
};

// Stage "html", where it is asked for. Each point that is drawn has its own distance to the other
// mesh; large triangles are divided, as they may be far from it between their corners.
void write_distance_page_stage(const HtmlRequest& request, DistancePage page, Run& run);

}  // namespace meshrepair
