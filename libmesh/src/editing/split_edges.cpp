// SPDX-License-Identifier: MIT
// In rounds: each halves all edges that are longer than a limit, which falls to the length that is
// asked for. A triangle with one, two or three such edges becomes two, three or four.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <base/internal/hash_index.h>
#include <mesh/split_edges.h>

namespace meshrepair {
namespace {

using internal::hash_mix;
using internal::HashIndex;

using Edge = std::array<std::uint32_t, 2>;
using Triangle = std::array<std::uint32_t, 3>;

constexpr std::uint32_t kWhole = HashIndex::kNone;

// The middles of edges that are halved in one round.
class Middles {
 public:
  explicit Middles(std::vector<Vec3d>& points)
      : points_(points), first_(points.size()), index_(points.size()) {}

  std::uint32_t of(std::uint32_t a, std::uint32_t b) {
    const Edge edge = {std::min(a, b), std::max(a, b)};
    const auto fresh = static_cast<std::uint32_t>(edges_.size());
    if (index_.full(fresh)) {
      index_.grow(fresh, [&](std::uint32_t i) { return hash(edges_[i]); });
    }
    const std::uint32_t i = index_.find_or_insert(
        hash(edge), fresh, [&](std::uint32_t other) { return edges_[other] == edge; });
    if (i == fresh) {
      edges_.push_back(edge);
      points_.emplace_back(0.5 * points_[edge[0]] + 0.5 * points_[edge[1]]);
    }
    return static_cast<std::uint32_t>(first_ + i);
  }

 private:
  static std::uint64_t hash(const Edge& edge) { return hash_mix(hash_mix(0, edge[0]), edge[1]); }

  std::vector<Vec3d>& points_;
  std::size_t first_;
  HashIndex index_;
  std::vector<Edge> edges_;
};

class Splitter {
 public:
  explicit Splitter(TriangleSoup& soup) : soup_(soup) {}

  [[nodiscard]] double longest() const {
    double squared = 0;
    for (const Triangle& t : soup_.triangles) {
      for (std::size_t k = 0; k < 3; ++k)
        squared = std::max(squared, square_of(t[k], t[(k + 1) % 3]));
    }
    return std::sqrt(squared);
  }

  // Halves what is longer, until nothing is. False where that would be too many triangles.
  bool halve_all(double limit, std::size_t most) {
    limit_ = limit * limit;
    while (true) {
      std::size_t halved = 0;
      for (const Triangle& t : soup_.triangles) halved += edges_to_halve(t);
      if (halved == 0) return true;
      if (soup_.triangles.size() + halved > most) return false;
      halve_once();
    }
  }

 private:
  [[nodiscard]] double square_of(std::uint32_t a, std::uint32_t b) const {
    return (soup_.points[a] - soup_.points[b]).squaredNorm();
  }
  [[nodiscard]] bool is_long(std::uint32_t a, std::uint32_t b) const {
    return square_of(a, b) > limit_;
  }
  [[nodiscard]] std::size_t edges_to_halve(const Triangle& t) const {
    return static_cast<std::size_t>(is_long(t[0], t[1])) +
           static_cast<std::size_t>(is_long(t[1], t[2])) +
           static_cast<std::size_t>(is_long(t[2], t[0]));
  }

  void halve_once() {
    Middles middles(soup_.points);
    std::vector<Triangle> before;
    before.swap(soup_.triangles);
    soup_.triangles.reserve(2 * before.size());
    for (const Triangle& t : before) {
      Triangle middle{};  // of the edge from each corner to the next
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3];
        middle[k] = is_long(a, b) ? middles.of(a, b) : kWhole;
      }
      divide(t, middle);
    }
  }

  void divide(const Triangle& t, const Triangle& middle) {
    const auto whole = static_cast<std::size_t>(std::count(middle.begin(), middle.end(), kWhole));
    if (whole == 3) return soup_.triangles.push_back(t);
    if (whole == 0) {
      for (std::size_t k = 0; k < 3; ++k) add(t[k], middle[k], middle[(k + 2) % 3]);
      return add(middle[0], middle[1], middle[2]);
    }
    // Turned so that the first edge is the one of its kind: the only one halved, or the only whole
    // one.
    const bool one = whole == 2;
    std::size_t k = 0;
    while ((middle[k] != kWhole) != one) ++k;
    const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
    if (one) {
      add(t[k], middle[k], t[last]);
      return add(middle[k], t[next], t[last]);
    }
    add(t[last], middle[last], middle[next]);
    add(t[k], t[next], middle[next]);
    return add(t[k], middle[next], middle[last]);
  }

  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    soup_.triangles.push_back({a, b, c});
  }

  TriangleSoup& soup_;
  double limit_ = 0;
};

}  // namespace

TriangleSoup split_edges(TriangleSoup soup, double length, std::size_t most) {
  Splitter splitter(soup);
  double limit = splitter.longest();
  if (!(length > 0) || !std::isfinite(limit)) return soup;
  while (limit > length) {
    limit = std::max(limit / 2, length);
    if (!splitter.halve_all(limit, most)) break;
  }
  return soup;
}

}  // namespace meshrepair
