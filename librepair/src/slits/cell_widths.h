// How thin cells are.
#pragma once

#include <optional>
#include <vector>

#include <extract/cell_complex.h>

namespace meshrepair::internal {

struct CellWidth {
  double width;    // in grid units
  PlaneId across;  // its normal is the direction across the cell
};

// Measures cells of a complex one by one, from rounded coordinates.
class CellWidths {
 public:
  // Cells wider than `most` have no width.
  CellWidths(const CellComplex& complex, double most) : complex_(complex), most_(most) {}

  // The least distance of a facet's plane from the vertex farthest from it, and the lowest such
  // plane. A convex cell may be thinner between two edges, but not by much. A few products for a
  // cell that is too wide; else linear in it for each plane that it is thin across.
  [[nodiscard]] std::optional<CellWidth> measure(CellId cell);

 private:
  struct Sheet {
    PlaneId plane;
    VertexId on;
  };

  void find_sheets(CellId cell);
  void drop_wide_sheets();
  void find_corners(CellId cell);
  [[nodiscard]] double distance(VertexId corner, const Sheet& sheet) const;
  [[nodiscard]] double width_from(const Sheet& sheet, double most) const;

  const CellComplex& complex_;
  double most_;
  std::vector<Sheet> sheets_;  // of the cell that is looked at, one for each plane of a facet
  std::vector<VertexId> corners_;
};

}  // namespace meshrepair::internal
