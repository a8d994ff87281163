// SPDX-License-Identifier: MIT
// --html of bspbool: the operands, and what was made of them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <extract/surface.h>
#include <mesh/length_unit.h>

#include "options/show_requests.h"
#include "page/html_report.h"
#include "program/program.h"
#include "report/findings.h"

namespace meshrepair {

// Of the meshes in one soup, one after the other.
struct GivenOperand {
  std::string name;                 // for people
  std::size_t points = 0;           // of it in the soup
  std::size_t triangles = 0;        // likewise
  std::size_t solid_triangles = 0;  // of what was combined: the mesh, repaired if need be
};

struct BooleanPage {
  const std::vector<GivenOperand>& operands;
  const Drawn given;      // all of them
  const Surface& result;  // its sources count through the triangles of all solids
  const Attributes& result_attributes;
  const std::vector<std::string>& inputs;  // files of the operands
  View::Up up = View::Up::z;
  std::optional<LengthUnit> unit;
};

// Stage "html", where it is asked for. Each operand is checked alone, as they may well cross.
void write_boolean_page_stage(const HtmlRequest& request, const BooleanPage& page, Run& run,
                              Findings& findings);

}  // namespace meshrepair
