#include "cell_widths.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

}  // namespace meshrepair::internal
