// Which triangles reach into which rows of a picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "raster/snapped_triangle.h"

namespace meshrepair {

// Rows in bands of one height. Most triangles reach into few bands, and are listed in each; for
// those that reach into more there is one list, so that needles take no memory for each band.
class RowsOfTriangles {
 public:
  // Of each triangle the rows of samples that it reaches into, of `rows` in all; empty where it is
  // not drawn.
  RowsOfTriangles(std::span<const Range> rows_of, std::size_t rows, std::size_t rows_of_band);

  [[nodiscard]] std::size_t bands() const { return begin_.size() - 1; }
  [[nodiscard]] Range rows(std::size_t band) const;
  // All that reach into it, and some others.
  template <class Visit>
  void visit(std::size_t band, const Visit& visit) const {
    for (std::size_t i = begin_[band]; i < begin_[band + 1]; ++i) visit(listed_[i]);
    for (const std::uint32_t triangle : tall_) visit(triangle);
  }

 private:
  std::size_t rows_, rows_of_band_;
  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> listed_;
  std::vector<std::uint32_t> tall_;
};

}  // namespace meshrepair
