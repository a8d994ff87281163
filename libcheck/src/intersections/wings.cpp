// SPDX-License-Identifier: MIT
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
  std::vector<std::uint32_t> first(corners.end(), kNone);
  std::vector<char> shared(corners.end(), 0);
  for (const auto& triangle : soup.triangles) {
    for (const std::uint32_t p : triangle) {
      std::uint32_t& known = first[corners.corner(p)];
      if (known == kNone) known = p;
      if (known != p) shared[corners.corner(p)] = 1;
    }
  }
  return shared;
}

Wing wing_of(const TriangleSoup& soup, std::uint32_t t, std::size_t k,
             const CornerTriangle& triangle) {
  const std::size_t l = (k + 1) % 3;
  const bool turn = triangle.corner[k] > triangle.corner[l];
  const std::size_t from = turn ? l : k, to = turn ? k : l;
  const auto& ids = soup.triangles[t];
  return {{std::min(ids[k], ids[l]), std::max(ids[k], ids[l])},
          t,
          !turn,
          {triangle.at[from], triangle.at[to], triangle.at[(k + 2) % 3]}};
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

SharedEdges::SharedEdges(const SoupCorners& corners) : corners_(corners) {
  const std::vector<char> shared = find_shared(corners);
  const TriangleSoup& soup = corners.soup();
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    IndexTriangle places{};
    bool any = false;
    for (std::size_t k = 0; k < 3; ++k) {
      places[k] = corners.corner(soup.triangles[t][k]);
      any |= shared[places[k]] != 0;
    }
    if (!any) continue;
    places_.push_back(places);
    triangles_.push_back(t);
  }
}

std::vector<Wing> SharedEdges::wings_at(std::span<const std::uint32_t> sides) const {
  std::vector<Wing> wings;
  CornerTriangle triangle;
  for (const std::uint32_t side : sides) {
    const std::uint32_t t = triangles_[side / 3];
    if (corners_.fetch(t, triangle) != Fetched::usable) continue;
    wings.push_back(wing_of(corners_.soup(), t, side % 3, triangle));
  }
  std::sort(wings.begin(), wings.end(), [](const Wing& a, const Wing& b) {
    return std::tie(a.edge, a.triangle) < std::tie(b.edge, b.triangle);
  });
  return order_around_edge(wings);
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
