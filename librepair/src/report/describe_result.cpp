// SPDX-License-Identifier: MIT
#include "describe_result.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <base/parallel.h>
#include <mesh/precision.h>
#include <mesh/topology.h>
#include <mesh/weld_points.h>

namespace meshrepair::internal {
namespace {

double closing_area(const Surface& surface) {
  TriangleSoup closing;
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    if (surface.source[t] == Surface::kNoSource) {
      closing.triangles.push_back(surface.mesh.triangles[t]);
    }
  }
  if (closing.triangles.empty()) return 0;
  closing.points = surface.mesh.points;
  return surface_area(closing);
}

bool is_same_point(const Vec3d& given, const Vec3d& p) {
  return p == given || p == rounded_to_float32(given);
}

// Its corners in their order, whichever is the first.
bool faces_as_source(const TriangleSoup& soup, const Surface& surface, std::size_t t) {
  const auto& from = soup.triangles[surface.source[t]];
  const auto& to = surface.mesh.triangles[t];
  constexpr std::array<std::size_t, 3> kFirst = {0, 1, 2};
  return std::any_of(kFirst.begin(), kFirst.end(), [&](std::size_t first) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d& p = surface.mesh.points[to[(first + k) % 3]];
      if (!is_same_point(soup.points[from[k]], p)) return false;
    }
    return true;
  });
}

bool has_given_corners(const TriangleSoup& soup, const Surface& surface, std::size_t t) {
  const auto& to = surface.mesh.triangles[t];
  const auto& from = soup.triangles[surface.source[t]];
  return std::all_of(from.begin(), from.end(), [&](std::uint32_t p) {
    return std::any_of(to.begin(), to.end(),
                       [&](std::uint32_t q) { return surface.mesh.points[q] == soup.points[p]; });
  });
}

}  // namespace

void describe_result(const CleanSoup& input, const Surface& surface, RepairReport& report) {
  report.triangles = find_triangle_fates(input, report.parts, surface);
  describe_output(surface, report);
}

void describe_output(const Surface& surface, RepairReport& report) {
  report.output = examine_topology(surface.mesh.triangles, surface.mesh.points.size());
  report.output_volume = signed_volume(surface.mesh);
  report.output_area = surface_area(surface.mesh);
  report.closing_area = closing_area(surface);
}

void compare_with_input(const TriangleSoup& soup, const Surface& surface, RepairReport& report) {
  struct Likeness {
    bool is_same = false, is_rounded = false;
  };
  std::vector<Likeness> alike(surface.source.size());
  parallel_for(alike.size(), [&](std::size_t t) {
    if (surface.source[t] == Surface::kNoSource) return;
    alike[t].is_same = faces_as_source(soup, surface, t);
    alike[t].is_rounded =
        has_corners_of_source(soup, surface, t) && !has_given_corners(soup, surface, t);
  });
  std::vector<char> is_there(soup.triangles.size(), 0), is_rounded(soup.triangles.size(), 0);
  report.same_triangles = alike.size() == soup.triangles.size();
  for (std::size_t t = 0; t < alike.size(); ++t) {
    const std::uint32_t source = surface.source[t];
    const bool is_new = source != Surface::kNoSource && is_there[source] == 0;
    report.same_triangles = report.same_triangles && is_new && alike[t].is_same;
    if (source == Surface::kNoSource) continue;
    is_there[source] = 1;
    if (alike[t].is_rounded) is_rounded[source] = 1;
  }
  TriangleFates& fates = report.triangles;
  const auto rounded =
      static_cast<std::size_t>(std::count(is_rounded.begin(), is_rounded.end(), 1));
  fates.rounded = std::min(rounded, fates.cut);
}

void note_moved_corners(const TriangleSoup& given, Surface& surface, RepairReport& report) {
  const std::vector<std::uint32_t> place = first_in_place(given.points, surface.mesh.points);
  for (std::size_t p = 0; p < place.size(); ++p) {
    if (place[p] >= given.points.size()) surface.input_point[p] = 0;
  }
  std::vector<char> is_whole(given.triangles.size(), 0);
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    const std::uint32_t source = surface.source[t];
    if (source == Surface::kNoSource) continue;
    const auto& corners = surface.mesh.triangles[t];
    const auto& of = given.triangles[source];
    const bool has_all = std::all_of(of.begin(), of.end(), [&](std::uint32_t p) {
      return std::any_of(corners.begin(), corners.end(), [&](std::uint32_t q) {
        return surface.mesh.points[q] == given.points[p];
      });
    });
    if (has_all) is_whole[source] = 1;
  }
  const auto whole = static_cast<std::size_t>(std::count(is_whole.begin(), is_whole.end(), 1));
  TriangleFates& fates = report.triangles;
  const std::size_t all = fates.untouched + fates.cut;
  fates.untouched = std::min(whole, fates.untouched);
  fates.cut = all - fates.untouched;
}

bool has_corners_of_source(const TriangleSoup& soup, const Surface& surface, std::size_t t) {
  const auto& from = soup.triangles[surface.source[t]];
  const auto& to = surface.mesh.triangles[t];
  return std::all_of(from.begin(), from.end(), [&](std::uint32_t p) {
    const Vec3d &given = soup.points[p], single = rounded_to_float32(given);
    return std::any_of(to.begin(), to.end(), [&](std::uint32_t q) {
      const Vec3d& point = surface.mesh.points[q];
      return point == given || point == single;
    });
  });
}

}  // namespace meshrepair::internal
