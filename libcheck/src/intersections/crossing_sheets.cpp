// SPDX-License-Identifier: MIT
// Idea: going round the edge one meets both triangles of each sheet. Two sheets cross if and only
// if they are met by turns, so brackets tell whether any two do.
#include "crossing_sheets.h"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

#include "wings.h"

namespace meshrepair::internal {
namespace {

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
  using Pairs = std::vector<std::array<std::uint32_t, 2>>;
  const auto visit = [](Pairs& pairs, const std::vector<Wing>& wings) {
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
  };
  const auto join = [](Pairs& all, const Pairs& part) {
    all.insert(all.end(), part.begin(), part.end());
  };
  Pairs pairs = SharedEdges(corners).gather<Pairs>(visit, join);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace meshrepair::internal
