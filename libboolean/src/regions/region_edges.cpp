// SPDX-License-Identifier: MIT
#include "region_edges.h"

#include <algorithm>
#include <span>
#include <utility>

#include <exact/double_predicates.h>
#include <mesh/edge_table.h>

namespace meshrepair::internal {
namespace {

// Counter-clockwise from the first. False if two are in one direction. None is without area.
bool sort_pages(const std::vector<Vec3d>& points, const Vec3d& a, const Vec3d& b,
                std::vector<EdgePage>& pages) {
  const auto turn = [&](const EdgePage& p, const EdgePage& q) {
    return orientation(a, b, points[p.apex], points[q.apex]);
  };
  for (std::size_t i = 1; i < pages.size(); ++i) pages[i].half = -turn(pages[0], pages[i]);
  std::sort(pages.begin() + 1, pages.end(), [&](const EdgePage& p, const EdgePage& q) {
    if (p.half != q.half) return p.half < q.half;
    return p.half != 0 && turn(p, q) > 0;
  });
  // What is coplanar with the first is taken to be opposite: else the two would overlap.
  for (std::size_t i = 1; i + 1 < pages.size(); ++i) {
    const EdgePage &p = pages[i], &q = pages[i + 1];
    if (p.half == q.half && (p.half == 0 || turn(p, q) <= 0)) return false;
  }
  return true;
}

}  // namespace

bool is_turned(const std::vector<Vec3d>& points, std::uint32_t a, std::uint32_t b,
               std::vector<EdgePage>& pages) {
  if (std::any_of(pages.begin(), pages.end(), [&](const EdgePage& page) {
        return projection_axis(points[a], points[b], points[page.apex]) < 0;
      })) {
    return true;
  }
  if (pages.size() > 2 && !sort_pages(points, points[a], points[b], pages)) return true;
  for (std::size_t i = 0; i < pages.size(); ++i) {
    if (pages[i].counter != pages[(i + 1) % pages.size()].clockwise) return true;
  }
  return false;
}

EdgePage page_at(std::uint32_t a, std::uint32_t b, const std::array<std::uint32_t, 3>& corners,
                 const std::array<std::uint32_t, 2>& sides) {
  std::size_t k = 0;
  while (corners[k] == a || corners[k] == b) ++k;
  // In front is counter-clockwise of a triangle that passes the edge from a to b.
  const bool is_along = corners[(k + 1) % 3] == a;
  return {corners[k], sides[is_along ? 1 : 0], sides[is_along ? 0 : 1], 0};
}

std::vector<std::uint32_t> triangles_at_turned_edges(const TriangleSoup& mesh,
                                                     const TriangleSides& sides) {
  std::vector<std::uint32_t> turned;
  std::vector<EdgePage> pages;
  EdgeTable(mesh.triangles).for_each_edge([&](std::span<const std::uint32_t> edge) {
    const std::uint32_t a = side_start(mesh.triangles, edge[0]);
    const std::uint32_t b = side_start(mesh.triangles, next_side(edge[0]));
    pages.clear();
    for (const std::uint32_t s : edge) {
      pages.push_back(page_at(a, b, mesh.triangles[s / 3], sides[s / 3]));
    }
    if (is_turned(mesh.points, a, b, pages)) turned.push_back(edge[0] / 3);
  });
  return turned;
}

}  // namespace meshrepair::internal
