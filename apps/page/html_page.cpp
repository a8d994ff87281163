// SPDX-License-Identifier: MIT
#include "page/html_page.h"

#include <cstddef>
#include <string_view>

#include <spdlog/fmt/fmt.h>

#include <base/assert.h>

#include "page/viewer_page.h"

namespace meshrepair {

std::string json_for_html(const Json& json) {
  const std::string text = json.dump(-1, true);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    // These are in strings alone.
    if (c == '<' || c == '>' || c == '&') {
      safe += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      safe += c;
    }
  }
  return safe;
}

std::string html_page(const Json& facts, const std::vector<PageText>& texts) {
  const std::string_view page = viewer_page();
  const std::size_t place = page.find(kPlaceOfData);
  MESHREPAIR_ASSERT(place != std::string_view::npos);
  std::string text(page.substr(0, place));
  text += R"(<script type="application/json" id="facts">)" + json_for_html(facts) + "</script>\n";
  for (const PageText& one : texts) {
    text += R"(<script type="text/plain" id=")" + one.id + "\">" + one.text + "</script>\n";
  }
  return text.append(page.substr(place + kPlaceOfData.size() + 1));
}

}  // namespace meshrepair
