// What a command line says of the page that a report is to be.
#pragma once

#include <cstddef>
#include <string>

namespace meshrepair {

struct HtmlRequest {
  std::string path;                        // empty: none is asked for
  std::size_t most_triangles = 1'000'000;  // of each mesh that are drawn

  [[nodiscard]] bool wanted() const { return !path.empty(); }
};

}  // namespace meshrepair
