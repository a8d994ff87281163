#include <cmath>
#include <vector>

#include <bsp/edge_table.h>
#include <repair/orient_parts.h>

namespace meshrepair {
namespace {

// Across an edge with exactly two triangles: the neighbour, and whether they agree as they are.
struct Neighbour {
  std::uint32_t triangle = ~std::uint32_t{0};
  bool agrees = true;
};

using Neighbours = std::vector<std::array<Neighbour, 3>>;

Neighbours find_neighbours(const std::vector<IndexTriangle>& triangles) {
  Neighbours neighbours(triangles.size());
  EdgeTable(triangles).for_each_edge([&](std::span<const std::uint32_t> sides) {
    if (sides.size() != 2) return;
    const bool agrees = side_start(triangles, sides[0]) != side_start(triangles, sides[1]);
    neighbours[sides[0] / 3][sides[0] % 3] = {sides[1] / 3, agrees};
    neighbours[sides[1] / 3][sides[1] % 3] = {sides[0] / 3, agrees};
  });
  return neighbours;
}

double area_of(const CleanSoup& soup, TriangleId t) {
  const auto& c = soup.triangles[t].corners;
  const Plane plane =
      plane_through(soup.grid_points[c[0]], soup.grid_points[c[1]], soup.grid_points[c[2]]);
  return std::hypot(static_cast<double>(plane.normal[0]), static_cast<double>(plane.normal[1]),
                    static_cast<double>(plane.normal[2]));
}

class PartOrienter {
 public:
  PartOrienter(const CleanSoup& soup, OrientReport& report, ProgressObserver* progress)
      : soup_(soup),
        report_(report),
        check_(progress),
        neighbours_(find_neighbours(index_triangles(soup))),
        turn_(soup.triangles.size(), kUnseen) {}

  IdVector<TriangleId, std::int32_t> run() {
    for (std::uint32_t t = 0; t < turn_.size(); ++t) {
      if (turn_[t] == kUnseen) orient_part_of(t);
    }
    IdVector<TriangleId, std::int32_t> winding = windings_of(soup_);
    for (std::uint32_t t = 0; t < turn_.size(); ++t) {
      if (turn_[t] == kTurn) winding[TriangleId(t)] = -winding[TriangleId(t)];
      report_.turned_triangles += turn_[t] == kTurn;
    }
    return winding;
  }

 private:
  static constexpr std::int8_t kUnseen = 0;
  static constexpr std::int8_t kKeep = 1;
  static constexpr std::int8_t kTurn = 2;

  void orient_part_of(std::uint32_t seed) {
    ++report_.parts;
    part_.assign(1, seed);
    turn_[seed] = kKeep;
    bool consistent = true;
    for (std::size_t i = 0; i < part_.size(); ++i) {
      check_.tick();
      const std::uint32_t t = part_[i];
      for (const Neighbour& n : neighbours_[t]) {
        if (n.triangle == ~std::uint32_t{0}) continue;
        const bool turn = (turn_[t] == kTurn) == n.agrees;
        if (turn_[n.triangle] == kUnseen) {
          turn_[n.triangle] = turn ? kTurn : kKeep;
          part_.push_back(n.triangle);
        } else {
          consistent &= (turn_[n.triangle] == kTurn) == turn;
        }
      }
    }
    if (!consistent) {
      ++report_.unorientable_parts;
      for (const std::uint32_t t : part_) turn_[t] = kKeep;
    } else {
      turn_smaller_area();
    }
  }

  void turn_smaller_area() {
    double kept = 0;
    double turned = 0;
    for (const std::uint32_t t : part_) {
      (turn_[t] == kTurn ? turned : kept) += area_of(soup_, TriangleId(t));
    }
    if (turned <= kept) return;
    for (const std::uint32_t t : part_) turn_[t] = turn_[t] == kTurn ? kKeep : kTurn;
  }

  const CleanSoup& soup_;
  OrientReport& report_;
  CancelCheck check_;
  Neighbours neighbours_;
  std::vector<std::int8_t> turn_;
  std::vector<std::uint32_t> part_;
};

}  // namespace

IdVector<TriangleId, std::int32_t> orient_parts(const CleanSoup& soup, OrientReport& report,
                                                ProgressObserver* progress) {
  report = {};
  return PartOrienter(soup, report, progress).run();
}

IdVector<TriangleId, std::int32_t> windings_of(const CleanSoup& soup) {
  IdVector<TriangleId, std::int32_t> winding;
  winding.reserve(soup.triangles.size());
  for (const Triangle& t : soup.triangles) winding.push_back(t.winding);
  return winding;
}

std::vector<IndexTriangle> index_triangles(const CleanSoup& soup) {
  std::vector<IndexTriangle> triangles;
  triangles.reserve(soup.triangles.size());
  for (const Triangle& t : soup.triangles) {
    triangles.push_back({t.corners[0].value, t.corners[1].value, t.corners[2].value});
  }
  return triangles;
}

}  // namespace meshrepair
