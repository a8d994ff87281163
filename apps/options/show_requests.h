// SPDX-License-Identifier: MIT
// What a command line says of pictures, and of pages for browsers.
#pragma once

#include <cstddef>
#include <string>

#include <picture/pixels.h>
#include <picture/view.h>

namespace meshrepair {

// What is shown in the terminal: a picture, if it can draw one, or a bar of characters.
enum class Shown { nothing, automatic, sixel, kitty, bar };

struct PictureRequest {
  std::string path;  // empty: none is asked for
  PictureSize size;  // of each mesh
  View view;
  bool painted = false;  // with the colours of what is wrong, or became of it, not with its own
  Shown shown = Shown::nothing;

  [[nodiscard]] bool wanted() const { return !path.empty() || shown != Shown::nothing; }
};

// The page that a report is to be.
struct HtmlRequest {
  std::string path;                        // empty: none is asked for
  std::size_t most_triangles = 1'000'000;  // of each mesh that are drawn

  [[nodiscard]] bool wanted() const { return !path.empty(); }
};

}  // namespace meshrepair
