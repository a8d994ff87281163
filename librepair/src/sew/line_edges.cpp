// SPDX-License-Identifier: MIT
#include "line_edges.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

namespace meshrepair::internal {
namespace {

using Vector = std::array<std::int64_t, 3>;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector vector_of(const GridPoint& p) { return {p.x, p.y, p.z}; }

}  // namespace

LineEdge line_edge(const CleanSoup& soup, std::uint32_t side, PointId from, PointId to) {
  const Vector a = vector_of(soup.grid_points[from]), b = vector_of(soup.grid_points[to]);
  Vector way = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const std::int64_t divisor = std::gcd(std::gcd(way[0], way[1]), way[2]);
  std::size_t axis = 0;
  while (way[axis] == 0) ++axis;
  LineEdge edge;
  edge.side = side;
  edge.is_reversed = way[axis] < 0;
  for (std::int64_t& x : way) x /= edge.is_reversed ? -divisor : divisor;
  edge.line = {way, cross(a, way)};
  edge.low = a[axis], edge.high = b[axis];
  edge.at_low = from, edge.at_high = to;
  if (edge.is_reversed) {
    std::swap(edge.low, edge.high);
    std::swap(edge.at_low, edge.at_high);
  }
  return edge;
}

void sort_by_lines(std::vector<LineEdge>& edges) {
  std::sort(edges.begin(), edges.end(), [](const LineEdge& a, const LineEdge& b) {
    return std::tie(a.line, a.low, a.side) < std::tie(b.line, b.low, b.side);
  });
}

Overlap::Overlap(std::span<const LineEdge> edges) : edges_(edges) {
  for (const LineEdge& edge : edges) {
    corners_.push_back({edge.low, edge.at_low});
    corners_.push_back({edge.high, edge.at_high});
  }
  std::sort(corners_.begin(), corners_.end());
  corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
}

std::size_t Overlap::pieces() const {
  std::size_t pieces = 0;
  for (const LineEdge& edge : edges_) pieces += place_of(edge.high) - place_of(edge.low);
  return pieces;
}

int Overlap::least_edges() const {
  std::vector<int> change(corners_.size(), 0);  // of how many edges pieces are
  for (const LineEdge& edge : edges_) {
    ++change[place_of(edge.low)];
    --change[place_of(edge.high)];
  }
  int count = 0, least = std::numeric_limits<int>::max();
  for (std::size_t i = 0; i + 1 < change.size(); ++i) {
    count += change[i];
    least = std::min(least, count);
  }
  return least;
}

std::size_t Overlap::place_of(std::int64_t at) const {
  const auto place = std::lower_bound(corners_.begin(), corners_.end(), at,
                                      [](const auto& c, std::int64_t x) { return c.first < x; });
  return static_cast<std::size_t>(place - corners_.begin());
}

}  // namespace meshrepair::internal
