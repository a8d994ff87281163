// SPDX-License-Identifier: MIT
// Fewer triangles for a repaired surface: what can be asked, and what is told.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <simplify/decimate.h>

namespace meshrepair {

struct FewerTrianglesOptions {
  std::size_t most = 0;  // triangles of the result, or one fewer; 0: as they come
  double share = 0;      // the same, of the triangles that there were; where `most` is 0

  // Of each triangle of the input, DecimationOptions::labels. Empty: all are alike.
  std::vector<std::uint32_t> labels;

  [[nodiscard]] bool wanted() const { return most > 0 || share > 0; }
};

struct FewerTrianglesReport {
  bool done = false;       // the surface was certified, and still is
  std::size_t asked = 0;   // triangles
  std::size_t before = 0;  // triangles that there were
  DecimationReport collapses;
};

}  // namespace meshrepair
