// Which triangle is seen at each sample of a picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <base/shared_progress.h>
#include <mesh/soup.h>
#include <picture/camera.h>

#include "raster/rows_of_triangles.h"
#include "raster/snapped_triangle.h"

namespace meshrepair {

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
