#include "wings.h"

#include <algorithm>
#include <tuple>

#include <base/ids.h>
#include <exact/double_predicates.h>

namespace meshrepair::internal {
namespace {

// Of each corner whether points of several indices are there.
std::vector<char> find_shared(const SoupCorners& corners) {
  const TriangleSoup& soup = corners.soup();
  std::vector<std::uint32_t> first(soup.points.size(), kNone);
  std::vector<char> shared(soup.points.size(), 0);
  for (const auto& triangle : soup.triangles) {
    for (const std::uint32_t p : triangle) {
      std::uint32_t& known = first[corners.corner(p)];
      if (known == kNone) known = p;
      if (known != p) shared[corners.corner(p)] = 1;
    }
  }
  return shared;
}

int quarter_of(const Wing& wing, const Wing& first) {
  const auto& [p, q, tip] = first.at;
  const int side = orientation(p, q, tip, wing.at[2]);
  if (side != 0) return side > 0 ? 1 : 3;
  const int axis = projection_axis(p, q, tip);
  return orientation_along(axis, p, q, tip) == orientation_along(axis, p, q, wing.at[2]) ? 0 : 2;
}

bool comes_first(const Wing& a, const Wing& b) {
  if (a.quarter != b.quarter) return a.quarter < b.quarter;
  return a.quarter % 2 == 1 && orientation(a.at[0], a.at[1], a.at[2], b.at[2]) > 0;
}

}  // namespace

std::vector<Wing> find_wings(const SoupCorners& corners) {
  const std::vector<char> shared = find_shared(corners);
  const TriangleSoup& soup = corners.soup();
  std::vector<Wing> wings;
  CornerTriangle triangle;
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    const auto& ids = soup.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3;
      if (shared[corners.corner(ids[k])] == 0 && shared[corners.corner(ids[l])] == 0) continue;
      if (corners.fetch(t, triangle) != Fetched::usable) break;
      const bool turn = triangle.corner[k] > triangle.corner[l];
      const std::size_t from = turn ? l : k, to = turn ? k : l;
      wings.push_back({{triangle.corner[from], triangle.corner[to]},
                       {std::min(ids[k], ids[l]), std::max(ids[k], ids[l])},
                       t,
                       !turn,
                       {triangle.at[from], triangle.at[to], triangle.at[(k + 2) % 3]}});
    }
  }
  std::sort(wings.begin(), wings.end(), [](const Wing& a, const Wing& b) {
    return std::tie(a.place, a.edge, a.triangle) < std::tie(b.place, b.edge, b.triangle);
  });
  return wings;
}

std::vector<Wing> order_around_edge(std::span<const Wing> group) {
  std::vector<Wing> wings;
  for (std::size_t i = 0; i < group.size();) {
    std::size_t end = i;
    while (end < group.size() && group[end].edge == group[i].edge) ++end;
    if (end - i == 2)
      wings.insert(wings.end(), group.begin() + static_cast<std::ptrdiff_t>(i),
                   group.begin() + static_cast<std::ptrdiff_t>(end));
    i = end;
  }
  if (wings.size() < 4) return {};
  const Wing first = wings.front();
  for (Wing& wing : wings) wing.quarter = quarter_of(wing, first);
  std::sort(wings.begin(), wings.end(), comes_first);
  for (std::size_t i = 1; i < wings.size(); ++i) {
    if (!comes_first(wings[i - 1], wings[i])) return {};
  }
  return wings;
}

}  // namespace meshrepair::internal
