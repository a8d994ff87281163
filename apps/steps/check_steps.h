// SPDX-License-Identifier: MIT
// What meshcheck is asked, beside the mesh, and what it looks for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include <check/check_surface.h>
#include <check/thin_places.h>
#include <mesh/soup.h>

#include "options/command_line.h"
#include "program/program.h"
#include "report/findings.h"
#include "report/json_report.h"

namespace meshrepair {

struct CheckRequest {
  CheckOptions check;
  bool openings = false;  // look for narrow ones, too
  ThinOptions thin;       // look for what is thin, too, if its limit is above 0
};

// --weld, --places, --openings and --thickness.
void add_check_options(CommandLine& app, CheckRequest& request);

// What narrow openings there are: words for the table, and the same in the section of the report;
// nothing if they are not asked for.
[[nodiscard]] std::string add_openings(const TriangleSoup& soup, const SurfaceCheck& check,
                                       const CheckRequest& request, Json& section);

// Which faces nearly touch, and what joins them: words for the table, and the same in the section
// of the report; nothing where none do.
[[nodiscard]] std::string add_near_faces(const TriangleSoup& soup, const CheckRequest& request,
                                         Json& section);

// What is thin: words for the table, and the same in the section of the report. An empty text and
// no marks if it is not asked for.
struct ThinFound {
  std::string text;
  std::optional<ThinReport> report;

  [[nodiscard]] std::span<const std::uint8_t> marks() const;  // of triangles, if they are marked
};
// The report has `most_kept` places of each kind, or as many as its section.
[[nodiscard]] ThinFound add_thin_places(const TriangleSoup& soup, const SurfaceCheck& check,
                                        const CheckRequest& request, std::size_t most_kept,
                                        Json& section);

// The same of a result, into findings.thin. A limit in units of IN is multiplied by `scale`.
void thickness_stage(const TriangleSoup& result, ThinOptions options, double scale, Run& run,
                     Findings& findings);

}  // namespace meshrepair
