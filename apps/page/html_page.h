// SPDX-License-Identifier: MIT
// The page of a report: the viewer, and what it shows, in one file that needs no other.
#pragma once

#include <string>
#include <vector>

#include "report/json_report.h"

namespace meshrepair {

// For the inside of a <script>: nothing in it ends the element or begins markup, and all of it is
// ASCII. A byte that is not UTF-8 becomes the replacement character.
[[nodiscard]] std::string json_for_html(const Json& json);

// What a page holds besides its facts: a text without markup, and how the viewer finds it.
struct PageText {
  std::string id;  // "mesh-0": of pack_mesh(); "looks-0": of pack_looks(); "picture-0"
  std::string text;
};

// `facts` is what web/viewer/src/main.js reads.
[[nodiscard]] std::string html_page(const Json& facts, const std::vector<PageText>& texts);

}  // namespace meshrepair
