// SPDX-License-Identifier: MIT
// Which triangle is seen at each sample of a picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <base/shared_progress.h>
#include <mesh/soup.h>
#include <picture/camera.h>

#include "raster/snapped_triangle.h"
#include "snapped_triangle.h"

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

// The nearest one; in one place that which faces whoever looks, and of several that do the one of
// the least number. Not owned: the soup and the camera outlive it.
class VisibleTriangles {
 public:
  // `samples` along each side of a pixel.
  VisibleTriangles(const TriangleSoup& soup, const Camera& camera, unsigned samples);

  [[nodiscard]] std::size_t bands() const { return rows_.bands(); }
  [[nodiscard]] Range rows(std::size_t band) const { return rows_.rows(band); }
  [[nodiscard]] std::size_t columns() const { return columns_; }

  struct Seen {
    std::uint32_t triangle;
    bool from_behind;
  };
  // What is seen at each sample of a band, in an order that Seen is told from.
  using Sample = std::uint64_t;
  static constexpr Sample kNothing = 0;
  [[nodiscard]] static Seen seen(Sample sample);

  // Polls while it works.
  void look(std::size_t band, SharedProgress& progress, std::vector<Sample>& samples) const;

  [[nodiscard]] SnappedTriangle snapped_triangle(std::uint32_t triangle) const;

 private:
  [[nodiscard]] std::vector<Range> rows_of_triangles() const;
  void draw(std::uint32_t triangle, const Range& rows, std::vector<Sample>& samples) const;

  const TriangleSoup& soup_;
  const Camera& camera_;
  std::size_t columns_;
  std::vector<SnappedPoint> points_;
  RowsOfTriangles rows_;
};

}  // namespace meshrepair
