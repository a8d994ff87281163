// SPDX-License-Identifier: MIT
// --html of meshdist: how far meshes are from the first of them, as colours on both.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <check/mesh_distance.h>
#include <mesh/length_unit.h>

#include "page/html_report.h"

namespace meshrepair {

struct DistancePage {
  struct Mesh {
    std::string name;  // for people
    const TriangleSoup& soup;
  };
  struct Compared {
    Mesh b;
    const MeshDistance& distance;  // between A and it
  };
  Mesh a;
  std::vector<Compared> others;  // one at least; one of them is shown beside A at a time
  View::Up up = View::Up::z;
  std::optional<LengthUnit> unit;
  Json report;  // the sections of the report, for the page
};

// Stage "html", where it is asked for. Each point that is drawn has its own distance to the other
// mesh; large triangles are divided, as they may be far from it between their corners.
void write_distance_page_stage(const HtmlRequest& request, DistancePage page, Run& run);

}  // namespace meshrepair
