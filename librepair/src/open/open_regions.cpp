#include <algorithm>
#include <cstdint>
#include <utility>

#include <base/disjoint_sets.h>
#include <mesh/topology.h>
#include <repair/orient_parts.h>

#include "flat_sheets.h"
#include "open_sheets.h"

namespace meshrepair::internal {
namespace {

// Of the area of the triangles around a region, what may be uncovered: as of a hole in a plane.
constexpr double kMostUncovered = 0.95;

// Of the area of an open part, what has to bound something solid for that to be what was meant.
constexpr double kLeastBounding = 0.1;

using RegionTriangle = std::pair<std::uint32_t, std::uint32_t>;

// Regions are connected through uncovered facets: what is walled in has nothing to do with what is
// solid beside it. The lowest of its cells stands for a region.
class OpenRegions {
 public:
  OpenRegions(const CoveredCells& covered, std::vector<char>& solid)
      : complex_(covered.complex),
        cover_(covered.cover),
        solid_(solid),
        topology_(examine_topology(index_triangles(complex_.soup()), complex_.soup().points.size(),
                                   &places_)),
        regions_(solid.size()) {}

  std::size_t run() {
    if (places_.open_sides.empty()) return 0;
    find_parts();
    find_regions();
    find_walls();
    std::vector<char> opens(solid_.size(), 0);
    for (std::size_t i = 0; i < walls_.size();) {
      const std::size_t first = i;
      while (i < walls_.size() && walls_[i].first == walls_[first].first) ++i;
      opens[walls_[first].first] = is_open(first, i) ? 1 : 0;
    }
    for (std::uint32_t c = 0; c < solid_.size(); ++c) {
      if (solid_[c] != 0 && opens[regions_.root(c)] != 0) solid_[c] = 0;
    }
    return static_cast<std::size_t>(std::count(opens.begin(), opens.end(), 1));
  }

 private:
  // The open ones, and of these the ones that hardly bound anything.
  void find_parts() {
    open_.assign(topology_.parts, 0);
    for (const std::uint32_t side : places_.open_sides) open_[places_.parts[side / 3]] = 1;
    std::vector<double> area(topology_.parts, 0), bounding(topology_.parts, 0);
    for (FacetId f(0u); f < complex_.facets.end_id(); ++f.value) {
      const Facet& facet = complex_.facets[f];
      if (!cover_[f].opaque()) continue;
      const std::uint32_t part = part_of(cover_[f].triangle);
      const double size = facet_area(complex_, f);
      area[part] += size;
      if (is_solid(facet.above) != is_solid(facet.below)) bounding[part] += size;
    }
    for (std::size_t p = 0; p < area.size(); ++p) {
      hardly_bounds_.push_back(bounding[p] < kLeastBounding * area[p] ? 1 : 0);
    }
  }

  [[nodiscard]] std::uint32_t part_of(TriangleId t) const { return places_.parts[t.index()]; }

  [[nodiscard]] bool is_solid(CellId c) const { return c.valid() && solid_[c.index()] != 0; }

  void find_regions() {
    for (FacetId f(0u); f < complex_.facets.end_id(); ++f.value) {
      const Facet& facet = complex_.facets[f];
      if (!cover_[f].opaque() && is_solid(facet.above) && is_solid(facet.below)) {
        regions_.join(facet.above.value, facet.below.value);
      }
    }
  }

  // Which triangles bound which region, sorted, each pair once, and the areas of both kinds.
  void find_walls() {
    covered_area_.resize(solid_.size());
    uncovered_area_.resize(solid_.size());
    for (FacetId f(0u); f < complex_.facets.end_id(); ++f.value) {
      const Facet& facet = complex_.facets[f];
      const bool is_covered = cover_[f].opaque();
      if (!is_covered && is_solid(facet.above) == is_solid(facet.below)) continue;
      const double area = facet_area(complex_, f);
      for (const CellId cell : {facet.above, facet.below}) {
        if (!is_solid(cell)) continue;
        const std::uint32_t region = regions_.root(cell.value);
        (is_covered ? covered_area_ : uncovered_area_)[region] += area;
        if (is_covered) walls_.emplace_back(region, cover_[f].triangle.value);
      }
    }
    std::sort(walls_.begin(), walls_.end());
    walls_.erase(std::unique(walls_.begin(), walls_.end()), walls_.end());
  }

  // Of a range of walls, those of one region.
  [[nodiscard]] bool is_open(std::size_t begin, std::size_t end) {
    const auto first = walls_.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = walls_.begin() + static_cast<std::ptrdiff_t>(end);
    const auto all_are = [&](const std::vector<char>& parts) {
      return std::all_of(first, last,
                         [&](const auto& w) { return parts[part_of(TriangleId(w.second))] != 0; });
    };
    if (!all_are(open_)) return false;
    if (all_are(hardly_bounds_)) return true;
    const std::uint32_t region = first->first;
    if (uncovered_area_[region] > kMostUncovered * covered_area_[region]) return true;
    const CleanSoup& soup = complex_.soup();
    corners_.clear();
    for (auto wall = first; wall != last; ++wall) {
      for (const PointId p : soup.triangles[TriangleId(wall->second)].corners) {
        corners_.push_back(original_place(soup, p));
      }
    }
    return is_flat(corners_, rounding_);
  }

  const CellComplex& complex_;
  const IdVector<FacetId, Cover>& cover_;
  std::vector<char>& solid_;
  TopologyPlaces places_;
  const Topology topology_;
  std::vector<char> open_, hardly_bounds_;  // of each part
  const double rounding_ = rounding_of(complex_.soup());
  DisjointSets regions_;
  std::vector<RegionTriangle> walls_;
  std::vector<double> covered_area_, uncovered_area_;
  std::vector<Vec3d> corners_;
};

}  // namespace

std::size_t empty_open_regions(const CoveredCells& covered, std::vector<char>& solid) {
  return OpenRegions(covered, solid).run();
}

}  // namespace meshrepair::internal
