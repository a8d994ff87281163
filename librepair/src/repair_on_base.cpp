// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <mesh/weld_points.h>
#include <repair/explain_repair.h>
#include <repair/repair_on_base.h>

namespace meshrepair {
namespace {

// A soup without copies: triangles with the same corners, in whatever order.
struct DistinctSoup {
  TriangleSoup soup;
  std::vector<std::uint32_t> source;       // of each of its triangles, in the soup that was given
  std::size_t copies = 0, degenerate = 0;  // that were dropped

  explicit DistinctSoup(const TriangleSoup& given) {
    soup.points = given.points;
    const std::vector<std::uint32_t> first = first_in_place(given.points);
    std::vector<std::pair<std::array<std::uint32_t, 3>, std::uint32_t>> keys;
    for (std::uint32_t t = 0; t < given.triangles.size(); ++t) {
      auto corners = given.triangles[t];
      for (std::uint32_t& corner : corners) corner = first[corner];
      std::sort(corners.begin(), corners.end());
      if (std::adjacent_find(corners.begin(), corners.end()) == corners.end()) {
        keys.emplace_back(corners, t);
      }
    }
    std::sort(keys.begin(), keys.end());
    for (std::size_t i = 0; i < keys.size(); ++i) {
      if (i == 0 || keys[i].first != keys[i - 1].first) source.push_back(keys[i].second);
    }
    std::sort(source.begin(), source.end());
    copies = keys.size() - source.size();
    degenerate = given.triangles.size() - keys.size();
    for (const std::uint32_t t : source) {
      const auto& [a, b, c] = given.triangles[t];
      soup.triangles.push_back({first[a], first[b], first[c]});
    }
  }
};

bool has_corners_of_source(const TriangleSoup& soup, const Surface& surface, std::size_t t) {
  const auto& of_result = surface.mesh.triangles[t];
  const auto& of_source = soup.triangles[surface.source[t]];
  return std::all_of(of_result.begin(), of_result.end(), [&](std::uint32_t p) {
    return std::any_of(of_source.begin(), of_source.end(),
                       [&](std::uint32_t q) { return surface.mesh.points[p] == soup.points[q]; });
  });
}

// Walls and the floor are made up, and no triangles of the input.
void refer_to_given(const TriangleSoup& soup, const DistinctSoup& distinct, Surface& surface,
                    RepairReport& report) {
  enum : char { absent, cut, whole };
  std::vector<char> fate(soup.triangles.size(), absent);
  TriangleSoup made_up;
  for (std::size_t t = 0; t < surface.source.size(); ++t) {
    std::uint32_t& source = surface.source[t];
    if (source >= distinct.source.size()) {
      source = Surface::kNoSource;
      made_up.triangles.push_back(surface.mesh.triangles[t]);
      continue;
    }
    source = distinct.source[source];
    if (fate[source] != whole) fate[source] = has_corners_of_source(soup, surface, t) ? whole : cut;
  }
  made_up.points = surface.mesh.points;
  report.closing_area = surface_area(made_up);
  report.clean.triangles_in = soup.triangles.size();
  report.clean.duplicates += distinct.copies;
  report.clean.dropped_degenerate += distinct.degenerate;
  report.triangles.untouched =
      static_cast<std::size_t>(std::count(fate.begin(), fate.end(), whole));
  report.triangles.cut = static_cast<std::size_t>(std::count(fate.begin(), fate.end(), cut));
  report.triangles.rounded = std::min(report.triangles.rounded, report.triangles.cut);
}

void explain_base(const TriangleSoup& soup, const DistinctSoup& distinct, const Surface& surface,
                  RepairExplanation& explanation) {
  std::vector<TriangleFate> fates(soup.triangles.size(), TriangleFate::duplicate);
  for (std::size_t t = 0; t < distinct.source.size(); ++t) {
    fates[distinct.source[t]] = explanation.fates[t];
  }
  explanation.fates = std::move(fates);
  for (std::size_t t = 0; t < surface.source.size(); ++t) {
    if (surface.source[t] == Surface::kNoSource) explanation.origins[t] = TriangleOrigin::patch;
  }
}

}  // namespace

HoleOptions holes_over_floor(HoleOptions holes) {
  holes.largest_share = holes.largest_flat_share = std::numeric_limits<double>::max();
  holes.rings = false;
  return holes;
}

Surface repair_on_base(const TriangleSoup& soup, const ScanBaseOptions& base,
                       const RepairOptions& options, ScanBaseReport& stands, RepairReport& report) {
  ScanBaseOptions all_parts = base;
  all_parts.smallest_part = 0;
  RepairOptions of_any_size = options;
  of_any_size.holes = holes_over_floor(options.holes);
  const DistinctSoup distinct(soup);
  Surface surface = repair(with_base(distinct.soup, all_parts, stands), of_any_size, report);
  refer_to_given(soup, distinct, surface, report);
  if (options.explain) explain_base(soup, distinct, surface, report.explanation);
  return surface;
}

}  // namespace meshrepair
