// SPDX-License-Identifier: MIT
#include "seam_edges.h"

#include <algorithm>
#include <array>

namespace meshrepair::internal {
namespace {

struct GoneTriangle {
  std::uint32_t triangle, third;  // the corner that is not of the edge
};

std::array<GoneTriangle, 2> gone_triangles(const PointStar& star, std::size_t to) {
  const std::size_t before = star.before(to);
  return {{{star.triangles[to], star.link[star.after(to)]},
           {star.triangles[before], star.link[before]}}};
}

}  // namespace

SeamEdges::SeamEdges(const CollapsibleMesh& mesh, std::span<const std::uint8_t> sides)
    : mesh_(mesh), sides_(sides.begin(), sides.end()) {}

bool SeamEdges::is_seam(std::size_t triangle, std::uint32_t side) const {
  return !sides_.empty() && (sides_[triangle] >> side & 1) != 0;
}

bool SeamEdges::is_seam_between(std::uint32_t triangle, std::uint32_t a, std::uint32_t b) const {
  const auto& corners = mesh_.triangles()[triangle];
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t p = corners[k], q = corners[(k + 1) % 3];
    if ((p == a && q == b) || (p == b && q == a)) return is_seam(triangle, k);
  }
  return false;
}

std::vector<std::uint8_t> SeamEdges::count_ends(std::size_t points) const {
  std::vector<std::uint8_t> ends(points, 0);  // each from both sides
  for (std::size_t t = 0; t < sides_.size(); ++t) {
    const auto& corners = mesh_.triangles()[t];
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (!is_seam(t, k)) continue;
      for (const std::uint32_t p : {corners[k], corners[(k + 1) % 3]}) {
        ends[p] = static_cast<std::uint8_t>(std::min(ends[p] + 1, 254));
      }
    }
  }
  for (std::uint8_t& count : ends) count = static_cast<std::uint8_t>(count / 2);
  return ends;
}

bool SeamEdges::would_join(const PointStar& star, std::size_t to) const {
  const auto gone = gone_triangles(star, to);
  return std::any_of(gone.begin(), gone.end(), [&](const GoneTriangle& t) {
    return is_seam_between(t.triangle, star.point, t.third) &&
           is_seam_between(t.triangle, star.link[to], t.third);
  });
}

void SeamEdges::collapse(const PointStar& star, std::size_t to, const Collapse& collapse) {
  for (const auto& [triangle, third] : gone_triangles(star, to)) {
    if (!is_seam_between(triangle, star.point, third) &&
        !is_seam_between(triangle, star.link[to], third)) {
      continue;
    }
    for (const auto& t : collapse.fan) {
      if (t.next != third && t.last != third) continue;
      const auto& corners = mesh_.triangles()[t.triangle];
      // From the point to the one after it, or from the one before it to the point.
      const std::uint32_t start =
          t.next == third ? (t.was_of_to ? collapse.to : collapse.from) : third;
      const auto k = std::find(corners.begin(), corners.end(), start) - corners.begin();
      sides_[t.triangle] = static_cast<std::uint8_t>(sides_[t.triangle] | 1u << k);
    }
  }
}

}  // namespace meshrepair::internal
