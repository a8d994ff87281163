// SPDX-License-Identifier: MIT
// How thin cells are, and the thin cells near the boundary of a solid, as a graph whose minimum cut
// says which are solid.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <base/ids.h>
#include <base/progress.h>
#include <extract/cell_complex.h>
#include <extract/cover_facets.h>
#include <repair/thin_cells.h>

#include "common/minimum_cut.h"

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

// Of its normal and the direction across the cell, the least product of a side that is broad.
inline constexpr double kBroad = 0.5;

// A node is a thin cell; cells that are not thin are what the cut starts from and ends at. A facet
// costs its area if it is boundary.
class ThinCellGraph {
 public:
  static constexpr std::uint32_t kUnseen = kNone, kWide = kNone - 1;

  struct Node {
    CellId cell;
    CellWidth width;
    bool stays = false;
  };

  // A facet of the cell that is looked at.
  struct Side {
    FacetId facet;
    CellId other;   // invalid: outside the box
    double facing;  // of its outward normal and the direction across the cell, the product
  };

  // What is referred to has to outlive the graph. `solid` may change afterwards: the costs are of
  // what it was, the questions below are answered for what it is.
  ThinCellGraph(const CellComplex& complex, const IdVector<FacetId, Cover>& cover,
                const ThinCellsOptions& options, const std::vector<char>& solid);

  [[nodiscard]] std::vector<Node>& nodes() { return nodes_; }
  [[nodiscard]] const std::vector<CutNode>& costs() const { return costs_; }
  [[nodiscard]] const std::vector<CutEdge>& edges() const { return edges_; }

  // kWide, or more, for cells that are no nodes.
  [[nodiscard]] std::uint32_t node_of(CellId cell) const {
    return cell.valid() ? node_of_[cell.index()] : kWide;
  }

  // Until the next call.
  [[nodiscard]] const std::vector<Side>& sides_of(const Node& node);
  [[nodiscard]] CellId across(FacetId f, CellId cell) const {
    const Facet& facet = complex_.facets[f];
    return facet.below == cell ? facet.above : facet.below;
  }

  [[nodiscard]] bool is_solid(CellId cell) const {
    return cell.valid() && solid_[cell.index()] != 0;
  }
  [[nodiscard]] bool is_boundary(FacetId f) const {
    const Facet& facet = complex_.facets[f];
    return is_solid(facet.above) != is_solid(facet.below);
  }
  [[nodiscard]] bool is_cut(FacetId f) const {
    return !cover_[f].opaque() || cut_[cover_[f].triangle.index()] != 0;
  }

 private:
  struct Costs {
    double solid = 0, empty = 0;  // of what lies beside cells that are no nodes
  };

  // What lies between two nodes.
  struct Between {
    std::uint32_t node, other;
    double area;
  };

  void find_cut_triangles();
  void find_thin_cells();
  void find_costs();
  void scale_costs(const std::vector<Costs>& beside, const std::vector<Between>& between,
                   double scale);

  const CellComplex& complex_;
  const IdVector<FacetId, Cover>& cover_;
  const ThinCellsOptions& options_;
  const std::vector<char>& solid_;
  CancelCheck cancel_;
  std::vector<std::uint32_t> node_of_;  // of each cell
  std::vector<char> cut_;  // of each triangle, whether a piece of it is no boundary, or may be
  std::vector<Node> nodes_;
  std::vector<CutNode> costs_;
  std::vector<CutEdge> edges_;
  std::vector<Side> sides_;
};

}  // namespace meshrepair::internal
