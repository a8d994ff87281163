// SPDX-License-Identifier: MIT
#include "find_sheets.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include <base/disjoint_sets.h>
#include <base/ids.h>
#include <base/roots.h>
#include <mesh/edge_table.h>
#include <repair/orient_parts.h>
#include <repair/part_fates.h>

#include "open/open_sheets.h"

namespace meshrepair::internal {
namespace {

constexpr double kFittingShare = 0.01;

double rounded_to_one_digit(double x) {
  const double unit = power_of_ten(decimal_exponent(x));
  return std::max(1.0, std::floor(x / unit)) * unit;
}

// Of triangles that lie outside, those that are connected with an open edge through others of them.
class RimFinder {
 public:
  RimFinder(const CleanSoup& soup, const std::vector<std::uint8_t>& places,
            const std::vector<char>& lies_outside)
      : soup_(soup), places_(places), lies_outside_(lies_outside), sets_(lies_outside.size()) {}

  std::vector<char> run() {
    std::vector<std::uint32_t> rims;
    EdgeTable(index_triangles(soup_)).for_each_edge([&](std::span<const std::uint32_t> sides) {
      const std::uint32_t first = join_outside(sides);
      if (first != kNone && is_rim(sides)) rims.push_back(first);
    });
    std::vector<char> has_rim(lies_outside_.size(), 0);
    for (const std::uint32_t t : rims) has_rim[sets_.root(t)] = 1;
    std::vector<char> is_sheet = lies_outside_;
    for (std::uint32_t t = 0; t < is_sheet.size(); ++t) {
      if (has_rim[sets_.root(t)] == 0) is_sheet[t] = 0;
    }
    return is_sheet;
  }

 private:
  // The first triangle there that lies outside.
  std::uint32_t join_outside(std::span<const std::uint32_t> sides) {
    std::uint32_t first = kNone;
    for (const std::uint32_t side : sides) {
      if (lies_outside_[side / 3] == 0) continue;
      if (first == kNone) first = side / 3;
      sets_.join(first, side / 3);
    }
    return first;
  }

  // One triangle of the input is there, and no patch that bounds what is solid.
  [[nodiscard]] bool is_rim(std::span<const std::uint32_t> sides) const {
    std::size_t given = 0;
    for (const std::uint32_t side : sides) {
      if (soup_.triangles[TriangleId(side / 3)].source != Triangle::kNoSource) {
        ++given;
      } else if ((places_[side / 3] & kOnBoundary) != 0) {
        return false;
      }
    }
    return given == 1;
  }

  const CleanSoup& soup_;
  const std::vector<std::uint8_t>& places_;
  const std::vector<char>& lies_outside_;
  DisjointSets sets_;
};

}  // namespace

std::vector<char> find_sheets(const CleanSoup& soup, const std::vector<std::uint8_t>& places) {
  std::vector<char> lies_outside(soup.triangles.size(), 0);
  for (std::size_t t = 0; t < places.size(); ++t) {
    const bool is_given = soup.triangles[TriangleId(t)].source != Triangle::kNoSource;
    lies_outside[t] = is_given && (places[t] & kOutside) != 0 ? 1 : 0;
  }
  if (std::count(lies_outside.begin(), lies_outside.end(), 1) == 0) return lies_outside;
  std::vector<char> is_sheet = RimFinder(soup, places, lies_outside).run();
  const std::vector<char> flat = triangles_of_flat_parts(soup);
  for (std::size_t t = 0; t < is_sheet.size(); ++t) {
    if (flat[t] != 0) is_sheet[t] = lies_outside[t];
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
