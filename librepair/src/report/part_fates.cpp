// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdint>

#include <base/parallel.h>
#include <mesh/topology.h>
#include <repair/orient_parts.h>
#include <repair/part_fates.h>

namespace meshrepair {
namespace {

bool is_solid(const std::vector<char>& solid, CellId cell) {
  return cell.valid() && solid[cell.index()] != 0;
}

// Of a piece that has what is solid, or not, on its two sides.
std::uint8_t place_between(bool one_solid, bool other_solid) {
  if (one_solid != other_solid) return kOnBoundary;
  return one_solid ? kInside : kOutside;
}

}  // namespace

std::vector<std::uint8_t> places_of_triangles(const CellComplex& complex,
                                              const IdVector<FacetId, Cover>& cover,
                                              const std::vector<char>& solid) {
  std::vector<std::uint8_t> places(complex.soup().triangles.size(), 0);
  for (FacetId f(0u); f < complex.facets.end_id(); ++f.value) {
    if (!cover[f].opaque()) continue;
    places[cover[f].triangle.index()] |= place_between(is_solid(solid, complex.facets[f].above),
                                                       is_solid(solid, complex.facets[f].below));
  }
  return places;
}

PartFates find_part_fates(const CleanSoup& soup, const std::vector<std::uint8_t>& places) {
  PartFates fates;
  fates.places = places;
  for (TriangleId t(0u); t < soup.triangles.end_id(); ++t.value) {
    if (soup.triangles[t].source == Triangle::kNoSource) continue;
    const std::uint8_t place = places[t.index()];
    ++((place & kOnBoundary) != 0 ? fates.bounding_triangles
       : place == kInside         ? fates.inside_triangles
                                  : fates.outside_triangles);
  }
  if (std::all_of(places.begin(), places.end(),
                  [](std::uint8_t p) { return (p & kOnBoundary) != 0; })) {
    return fates;
  }
  TopologyPlaces topology;
  const std::size_t parts =
      examine_topology(index_triangles(soup), soup.points.size(), &topology).parts;
  std::vector<std::uint8_t> places_of_part(parts, 0);
  std::vector<char> is_open(parts, 0);
  for (const std::uint32_t side : topology.open_sides) is_open[topology.parts[side / 3]] = 1;
  std::vector<double> area(parts, 0);
  for (TriangleId t(0u); t < soup.triangles.end_id(); ++t.value) {
    const std::uint32_t part = topology.parts[t.index()];
    places_of_part[part] |= places[t.index()];
    const Triangle& triangle = soup.triangles[t];
    if (triangle.source != Triangle::kNoSource) area[part] += area_of(soup, triangle);
  }
  for (std::size_t part = 0; part < parts; ++part) {
    if ((places_of_part[part] & kOnBoundary) != 0) continue;
    // A part that coincides with another one in all its pieces has the fate of that one.
    if (places_of_part[part] == 0) continue;
    const bool outside = (places_of_part[part] & kOutside) != 0;
    PartsAndArea& fate = outside ? fates.enclosing_nothing : fates.inside_solid;
    ++fate.parts;
    fate.area += area[part];
    if (!outside && is_open[part] == 0) ++fates.closed_inside;
  }
  return fates;
}

std::vector<char> find_whole_triangles(const CleanSoup& input, const Surface& surface) {
  std::vector<char> whole(surface.mesh.triangles.size(), 0);
  const auto is_whole = [&](std::size_t t) {
    if (surface.source[t] == Surface::kNoSource) return false;
    // Sources ascend; of a triangle that was split beforehand, several have the same one.
    const auto found = std::lower_bound(
        input.triangles.begin(), input.triangles.end(), surface.source[t],
        [](const Triangle& triangle, std::uint32_t source) { return triangle.source < source; });
    if (found == input.triangles.end() || found->source != surface.source[t]) return false;
    const auto next = std::next(found);
    if (next != input.triangles.end() && next->source == found->source) return false;
    const auto& to = surface.mesh.triangles[t];
    return std::all_of(found->corners.begin(), found->corners.end(), [&](PointId p) {
      return std::any_of(to.begin(), to.end(), [&](std::uint32_t q) {
        return surface.mesh.points[q] == input.points[p];
      });
    });
  };
  parallel_for(whole.size(), [&](std::size_t t) { whole[t] = is_whole(t) ? 1 : 0; });
  return whole;
}

TriangleFates find_triangle_fates(const CleanSoup& input, const PartFates& parts,
                                  const Surface& surface) {
  TriangleFates fates;
  const std::vector<char> whole = find_whole_triangles(input, surface);
  fates.untouched = static_cast<std::size_t>(std::count(whole.begin(), whole.end(), 1));
  fates.cut = std::max(parts.bounding_triangles, fates.untouched) - fates.untouched;
  return fates;
}

}  // namespace meshrepair
