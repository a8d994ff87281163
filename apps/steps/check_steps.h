// SPDX-License-Identifier: MIT
// What meshcheck is asked, beside the mesh, and what it looks for.
#pragma once

#include <string>

#include <check/check_surface.h>
#include <mesh/soup.h>

#include "options/command_line.h"
#include "report/json_report.h"

namespace meshrepair {

struct CheckRequest {
  CheckOptions check;
  bool openings = false;  // look for narrow ones, too
};

// --weld, --places and --openings.
void add_check_options(CommandLine& app, CheckRequest& request);

// What narrow openings there are: words for the table, and the same in the section of the report;
// nothing if they are not asked for.
[[nodiscard]] std::string add_openings(const TriangleSoup& soup, const SurfaceCheck& check,
                                       const CheckRequest& request, Json& section);

// Which faces nearly touch, and what joins them: words for the table, and the same in the section
// of the report; nothing where none do.
[[nodiscard]] std::string add_near_faces(const TriangleSoup& soup, const CheckRequest& request,
                                         Json& section);

}  // namespace meshrepair
