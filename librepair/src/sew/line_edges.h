// SPDX-License-Identifier: MIT
// Edges of a clean soup by the lines that they are on, exactly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <base/ids.h>
#include <bsp/clean_soup.h>

#include "split_edges.h"

namespace meshrepair::internal {

// A side of a triangle, and where it is on its line.
struct LineEdge {
  // The same for all edges on one line. Grid coordinates have 27 bits, so moments have less than
  // 60.
  struct Line {
    std::array<std::int64_t, 3> direction{};  // without a common divisor; the first number that is
                                              // not 0 is above 0
    std::array<std::int64_t, 3> moment{};
    bool operator==(const Line&) const = default;
    bool operator<(const Line& other) const {
      return std::tie(direction, moment) < std::tie(other.direction, other.moment);
    }
  };

  Line line;
  std::int64_t low = 0, high = 0;  // along the line: a coordinate
  PointId at_low, at_high;
  std::uint32_t side = 0;  // 3 t + k
  bool is_reversed = false;
};

[[nodiscard]] LineEdge line_edge(const CleanSoup& soup, std::uint32_t side, PointId from,
                                 PointId to);

// By their lines, by where they begin on these, and by their sides.
void sort_by_lines(std::vector<LineEdge>& edges);

// Calls visit(std::span<const LineEdge>) for each longest run of edges of one line each of which
// has more than a corner in common with those before. `edges` are sorted by lines.
template <class Visit>
void for_each_overlap(const std::vector<LineEdge>& edges, Visit visit) {
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t end = first + 1;
    std::int64_t high = edges[first].high;
    while (end < edges.size() && edges[end].line == edges[first].line && edges[end].low < high) {
      if (edges[end].high > high) high = edges[end].high;
      ++end;
    }
    visit(std::span(edges).subspan(first, end - first));
    first = end;
  }
}

// Where more corners are on an edge, on average, edges and corners are many, and pieces would be
// the product of both.
inline constexpr std::size_t kMostPieces = 16;

// Edges of one line, and what their corners make of them. They have to outlive this.
class Overlap {
 public:
  explicit Overlap(std::span<const LineEdge> edges);

  // Of all edges together, from corner to corner.
  [[nodiscard]] std::size_t pieces() const;
  // Of how many edges a piece between two corners is at least.
  [[nodiscard]] int least_edges() const;
  // Calls visit(const EdgeSplit&) for each corner between the ends of each edge.
  template <class Visit>
  void for_each_split(Visit visit) const {
    for (const LineEdge& edge : edges_) {
      const auto length = static_cast<double>(edge.high - edge.low);
      for (std::size_t i = place_of(edge.low) + 1; corners_[i].first < edge.high; ++i) {
        const std::int64_t from_start =
            edge.is_reversed ? edge.high - corners_[i].first : corners_[i].first - edge.low;
        visit(EdgeSplit{edge.side, static_cast<double>(from_start) / length,
                        corners_[i].second.value});
      }
    }
  }

 private:
  [[nodiscard]] std::size_t place_of(std::int64_t at) const;

  std::span<const LineEdge> edges_;
  std::vector<std::pair<std::int64_t, PointId>> corners_;  // along the line
};

}  // namespace meshrepair::internal
