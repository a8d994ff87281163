// SPDX-License-Identifier: MIT
#include "thin_cell_graph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/Core>

namespace meshrepair::internal {

std::optional<CellWidth> CellWidths::measure(CellId cell) {
  find_sheets(cell);
  drop_wide_sheets();
  if (sheets_.empty()) return std::nullopt;
  find_corners(cell);
  std::optional<CellWidth> best;
  for (const Sheet& sheet : sheets_) {
    const double width = width_from(sheet, best ? best->width : most_);
    if (!(width <= most_) || (best && width >= best->width)) continue;
    best = {width, sheet.plane};
  }
  return best;
}

// Of each facet one corner, which is far from most of the others' planes.
void CellWidths::find_sheets(CellId cell) {
  sheets_.clear();
  corners_.clear();
  complex_.for_each_facet(cell, [&](FacetId f) {
    const Facet& facet = complex_.facets[f];
    const VertexId corner = complex_.origin(complex_.uses[facet.first_use]);
    sheets_.push_back({facet.plane, corner});
    corners_.push_back(corner);
  });
  const auto key = [](const Sheet& s) { return std::pair(s.plane, s.on); };
  std::sort(sheets_.begin(), sheets_.end(),
            [&](const Sheet& a, const Sheet& b) { return key(a) < key(b); });
  const auto is_same = [](const Sheet& a, const Sheet& b) { return a.plane == b.plane; };
  sheets_.erase(std::unique(sheets_.begin(), sheets_.end(), is_same), sheets_.end());
}

// What is far from one plane is likely far from the next, and looked at first.
void CellWidths::drop_wide_sheets() {
  const auto is_wide = [&](const Sheet& sheet) {
    for (VertexId& corner : corners_) {
      if (!(distance(corner, sheet) > most_)) continue;
      std::swap(corner, corners_.front());
      return true;
    }
    return false;
  };
  sheets_.erase(std::remove_if(sheets_.begin(), sheets_.end(), is_wide), sheets_.end());
}

void CellWidths::find_corners(CellId cell) {
  corners_.clear();
  complex_.for_each_facet(cell, [&](FacetId f) {
    complex_.for_each_use(
        f, [&](UseId use) { corners_.push_back(complex_.origin(complex_.uses[use])); });
  });
  std::sort(corners_.begin(), corners_.end());
  corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
}

double CellWidths::distance(VertexId corner, const Sheet& sheet) const {
  const std::array<double, 3>& normal = complex_.planes[sheet.plane].unit;
  const Point& p = complex_.vertices[corner];
  const Point& on = complex_.vertices[sheet.on];
  double along = 0;
  for (std::size_t i = 0; i < 3; ++i) along += normal[i] * (p.position[i] - on.position[i]);
  return std::abs(along) + static_cast<double>(p.error);
}

// Gives up beyond `most`.
double CellWidths::width_from(const Sheet& sheet, double most) const {
  double width = 0;
  for (const VertexId corner : corners_) {
    width = std::max(width, distance(corner, sheet));
    if (width > most) break;
  }
  return width;
}

namespace {

// What a cell costs that changes, of the area of its broad sides: what gains less is no sheet that
// comes near to another one, but the same one on the other side of the cell.
constexpr double kCostOfChange = 0.05;

// All costs add up to less than 2^60.
constexpr int kBitsOfCosts = 60;

Vec3d vector_of(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }

// Of a power of two above x.
int exponent_of(double x) {
  int exponent = 0;
  std::frexp(x, &exponent);
  return exponent + 1;
}

}  // namespace

ThinCellGraph::ThinCellGraph(const CellComplex& complex, const IdVector<FacetId, Cover>& cover,
                             const ThinCellsOptions& options, const std::vector<char>& solid)
    : complex_(complex),
      cover_(cover),
      options_(options),
      solid_(solid),
      cancel_(options.progress),
      node_of_(solid.size(), kUnseen),
      cut_(options.open.begin(), options.open.end()) {
  cut_.resize(complex.soup().triangles.size(), 0);
  find_cut_triangles();
  find_thin_cells();
  if (nodes_.empty()) return;
  find_costs();
}

void ThinCellGraph::find_cut_triangles() {
  for (FacetId f(0u); f < complex_.facets.end_id(); ++f.value) {
    if (cover_[f].opaque() && !is_boundary(f)) cut_[cover_[f].triangle.index()] = 1;
  }
}

// Those beside boundary that is cut, and from there on through thin ones: others, which are most
// of a complex, would not change.
void ThinCellGraph::find_thin_cells() {
  CellWidths widths(complex_, options_.within);
  const auto visit = [&](CellId cell) {
    cancel_.tick();
    if (!cell.valid() || node_of_[cell.index()] != kUnseen) return;
    const std::optional<CellWidth> width = widths.measure(cell);
    node_of_[cell.index()] = width ? static_cast<std::uint32_t>(nodes_.size()) : kWide;
    if (width) nodes_.push_back({cell, *width});
  };
  for (FacetId f(0u); f < complex_.facets.end_id(); ++f.value) {
    if (!is_boundary(f) || !is_cut(f)) continue;
    visit(complex_.facets[f].above);
    visit(complex_.facets[f].below);
  }
  for (std::size_t next = 0; next < nodes_.size(); ++next) {
    const CellId cell = nodes_[next].cell;
    complex_.for_each_facet(cell, [&](FacetId f) { visit(across(f, cell)); });
  }
}

// Areas, and then the costs that they are in the cut.
void ThinCellGraph::find_costs() {
  double total = 0;
  std::vector<Costs> beside(nodes_.size());
  std::vector<Between> between;
  for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
    cancel_.tick();
    const Node& node = nodes_[n];
    double broad = 0;
    for (const Side& side : sides_of(node)) {
      const double area = facet_area(complex_, side.facet);
      if (std::abs(side.facing) >= kBroad) broad += area;
      total += area;
      const std::uint32_t other = node_of(side.other);
      if (other < kWide) {
        if (other > n) between.push_back({n, other, area});
      } else {
        (is_solid(side.other) ? beside[n].empty : beside[n].solid) += area;
      }
    }
    (is_solid(node.cell) ? beside[n].empty : beside[n].solid) += kCostOfChange * broad;
    total += kCostOfChange * broad;
  }
  const double scale = std::ldexp(1.0, kBitsOfCosts - exponent_of(total));
  scale_costs(beside, between, scale);
}

// What is boundary is rounded down, and the rest up: nothing changes for the sake of rounding,
// which is about a grid unit squared where broad sheets are among the sides.
void ThinCellGraph::scale_costs(const std::vector<Costs>& beside,
                                const std::vector<Between>& between, double scale) {
  const auto cost = [&](double area, bool of_boundary) {
    return static_cast<std::int64_t>(of_boundary ? std::floor(area * scale)
                                                 : std::ceil(area * scale));
  };
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const bool solid = is_solid(nodes_[n].cell);
    costs_.push_back({cost(beside[n].solid, solid), cost(beside[n].empty, !solid)});
  }
  for (const Between& b : between) {
    const bool of_boundary = is_solid(nodes_[b.node].cell) != is_solid(nodes_[b.other].cell);
    edges_.push_back({b.node, b.other, cost(b.area, of_boundary)});
  }
}

const std::vector<ThinCellGraph::Side>& ThinCellGraph::sides_of(const Node& node) {
  sides_.clear();
  const Vec3d across_cell = vector_of(complex_.planes[node.width.across].unit);
  complex_.for_each_facet(node.cell, [&](FacetId f) {
    const Facet& facet = complex_.facets[f];
    const double facing = vector_of(complex_.planes[facet.plane].unit).dot(across_cell);
    sides_.push_back({f, across(f, node.cell), facet.below == node.cell ? facing : -facing});
  });
  return sides_;
}

}  // namespace meshrepair::internal
