// Idea: going round the edge one meets both triangles of each sheet. Two sheets cross if and only
// if they are met by turns, so brackets tell whether any two do.
#include "crossing_sheets.h"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

#include <bsp/double_predicates.h>
#include <bsp/ids.h>

namespace meshrepair::internal {
namespace {

// A triangle at an edge.
struct Wing {
  std::array<std::uint32_t, 2> place;  // of the edge: corners, ascending
  std::array<std::uint32_t, 2> edge;   // in indices of the soup, ascending: names the sheet
  std::uint32_t triangle;
  std::array<Vec3d, 3> at;  // the ends in the order of `place`, and the tip
  // Where the tip lies seen from the first wing: 0 in the same half plane, 1 before half a turn, 2
  // at half a turn, 3 after it.
  int quarter = 0;
};

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

std::vector<Wing> find_wings(const SoupCorners& corners) {
  const std::vector<char> shared = find_shared(corners);
  const TriangleSoup& soup = corners.soup();
  std::vector<Wing> wings;
  CornerTriangle triangle;
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    const auto& ids = soup.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3;
      if (shared[corners.corner(ids[k])] == 0 || shared[corners.corner(ids[l])] == 0) continue;
      if (corners.fetch(t, triangle) != Fetched::usable) break;
      const bool turn = triangle.corner[k] > triangle.corner[l];
      const std::size_t from = turn ? l : k, to = turn ? k : l;
      wings.push_back({{triangle.corner[from], triangle.corner[to]},
                       {std::min(ids[k], ids[l]), std::max(ids[k], ids[l])},
                       t,
                       {triangle.at[from], triangle.at[to], triangle.at[(k + 2) % 3]}});
    }
  }
  std::sort(wings.begin(), wings.end(), [](const Wing& a, const Wing& b) {
    return std::tie(a.place, a.edge, a.triangle) < std::tie(b.place, b.edge, b.triangle);
  });
  return wings;
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

// Those of sheets of two, in the order in which one meets them going round the edge; none where two
// leave in the same direction, for these overlap, and are found otherwise.
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

// A sheet by the positions of its wings in the order around the edge.
using Span = std::pair<std::size_t, std::size_t>;

// Sheets that are met by turns with another.
std::vector<Span> open_brackets(std::span<const Wing> wings) {
  std::vector<std::size_t> stack;
  for (std::size_t i = 0; i < wings.size(); ++i) {
    if (!stack.empty() && wings[stack.back()].edge == wings[i].edge) {
      stack.pop_back();
    } else {
      stack.push_back(i);
    }
  }
  std::sort(stack.begin(), stack.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(wings[a].edge, a) < std::tie(wings[b].edge, b);
  });
  std::vector<Span> spans;
  for (std::size_t i = 0; i + 1 < stack.size(); i += 2) spans.emplace_back(stack[i], stack[i + 1]);
  return spans;
}

}  // namespace

std::vector<std::array<std::uint32_t, 2>> find_crossing_sheets(const SoupCorners& corners) {
  std::vector<std::array<std::uint32_t, 2>> pairs;
  const std::vector<Wing> all = find_wings(corners);
  for (std::size_t i = 0; i < all.size();) {
    std::size_t end = i;
    while (end < all.size() && all[end].place == all[i].place) ++end;
    const std::vector<Wing> wings = order_around_edge({all.data() + i, end - i});
    i = end;
    const std::vector<Span> sheets = open_brackets(wings);
    for (std::size_t a = 0; a < sheets.size(); ++a) {
      for (std::size_t b = a + 1; b < sheets.size(); ++b) {
        const Span span = sheets[a];
        const auto inside = [&](std::size_t at) { return span.first < at && at < span.second; };
        if (inside(sheets[b].first) == inside(sheets[b].second)) continue;
        const std::uint32_t s = wings[span.first].triangle, t = wings[sheets[b].first].triangle;
        pairs.push_back({std::min(s, t), std::max(s, t)});
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace meshrepair::internal
