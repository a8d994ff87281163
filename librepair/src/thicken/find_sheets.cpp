#include "find_sheets.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <mesh/topology.h>
#include <repair/orient_parts.h>
#include <repair/part_fates.h>

#include "open/open_sheets.h"

namespace meshrepair::internal {
namespace {

constexpr double kFittingShare = 0.01;

double rounded_to_one_digit(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)));
  return std::max(1.0, std::floor(x / unit)) * unit;
}

}  // namespace

std::vector<char> find_sheets(const CleanSoup& soup, const std::vector<std::uint8_t>& places) {
  std::vector<char> is_sheet(soup.triangles.size(), 0);
  bool any = false;
  for (std::size_t t = 0; t < places.size(); ++t) {
    const bool is_given = soup.triangles[TriangleId(t)].source != Triangle::kNoSource;
    is_sheet[t] = is_given && (places[t] & kOutside) != 0 ? 1 : 0;
    any = any || is_sheet[t] != 0;
  }
  if (!any) return is_sheet;
  const std::vector<char> open = triangles_of_open_parts(index_triangles(soup), soup.points.size());
  const std::vector<char> flat = triangles_of_flat_parts(soup);
  for (std::size_t t = 0; t < is_sheet.size(); ++t) {
    if (open[t] + flat[t] == 0) is_sheet[t] = 0;
  }
  return is_sheet;
}

double diagonal_of(const CleanSoup& soup) {
  const GridBox box = bounding_box(soup);
  return soup.grid.unit * (as_vector(box.high) - as_vector(box.low)).norm();
}

double fitting_thickness(const CleanSoup& soup, const std::vector<char>& is_sheet) {
  std::vector<double> lengths;
  for (std::size_t t = 0; t < is_sheet.size(); ++t) {
    if (is_sheet[t] == 0) continue;
    const auto& [a, b, c] = soup.triangles[TriangleId(t)].corners;
    const auto& at = soup.points;
    lengths.insert(lengths.end(),
                   {(at[b] - at[a]).norm(), (at[c] - at[b]).norm(), (at[a] - at[c]).norm()});
  }
  if (lengths.empty()) return 0;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  const double fitting = std::min(kFittingShare * diagonal_of(soup), *middle);
  return fitting > 0 && std::isfinite(fitting) ? rounded_to_one_digit(fitting) : 0;
}

}  // namespace meshrepair::internal
