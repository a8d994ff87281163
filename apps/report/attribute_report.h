// SPDX-License-Identifier: MIT
// What triangles carry, for people and for reports.
#pragma once

#include <string>
#include <vector>

#include <mesh/attributes.h>
#include <mesh/soup.h>
#include <mesh/soup_format.h>

#include "report/json_report.h"

namespace meshrepair {

// "texture coordinates (12 seams)", "3 materials", ...; empty where there is nothing.
[[nodiscard]] std::vector<std::string> attribute_words(const TriangleSoup& soup,
                                                       const Attributes& attributes);

// What lost_attributes() says, joined by commas; it says how what can be kept can be kept.
[[nodiscard]] std::string lost_words(const TriangleSoup& soup, const Attributes& all,
                                     const Attributes& held, SoupFormat format);

// Section "attributes" of a report.
[[nodiscard]] Json attributes_section(const TriangleSoup& soup, const Attributes& attributes);

}  // namespace meshrepair
