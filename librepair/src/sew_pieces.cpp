// Pieces have corners in points of the input, which they share with triangles that were not cut,
// and corners of their own. The latter are vertices of the result as they are. At the former, fans
// of triangles are joined over their edges, and each is a vertex.
#include "sew_pieces.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>

#include <bsp/disjoint_sets.h>
#include <bsp/edge_table.h>
#include <bsp/ids.h>

namespace meshrepair::internal {
namespace {

auto coordinates(const Vec3d& p) { return std::tuple(p.x(), p.y(), p.z()); }

class PieceSewer {
 public:
  PieceSewer(const CleanSoup& soup, const Tangles& tangles, const std::vector<PatchSides>& sides,
             const Surface& pieces)
      : soup_(soup), tangles_(tangles), sides_(sides), pieces_(pieces) {}

  std::optional<Surface> run() {
    list_points_of_tangles();
    std::uint32_t next = 0;
    for (std::uint32_t i = 0; i < pieces_.mesh.triangles.size(); ++i) {
      const std::uint32_t source = pieces_.source[i];
      for (; next < source; ++next) add_if_kept(next);
      add(numbers_of_piece(i), source);
    }
    for (; next < tangles_.tangled.size(); ++next) add_if_kept(next);
    if (!join_fans()) return std::nullopt;
    return std::move(result_);
  }

 private:
  // Corners have the numbers of the soup's points, or of the pieces' points after these.
  using Numbers = IndexTriangle;

  void list_points_of_tangles() {
    for (std::size_t t = 0; t < tangles_.tangled.size(); ++t) {
      if (tangles_.tangled[t] == 0) continue;
      for (const std::uint32_t p : tangles_.on_grid.triangles[t]) by_place_.push_back(p);
    }
    std::sort(by_place_.begin(), by_place_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return coordinates(soup_.points[PointId(a)]) < coordinates(soup_.points[PointId(b)]);
    });
  }

  [[nodiscard]] std::uint32_t number_of(std::uint32_t point) const {
    const Vec3d& at = pieces_.mesh.points[point];
    if (pieces_.input_point[point] != 0) {
      const auto found = std::lower_bound(
          by_place_.begin(), by_place_.end(), at, [&](std::uint32_t p, const Vec3d& q) {
            return coordinates(soup_.points[PointId(p)]) < coordinates(q);
          });
      if (found != by_place_.end() && soup_.points[PointId(*found)] == at) return *found;
    }
    return static_cast<std::uint32_t>(soup_.points.size()) + point;
  }

  [[nodiscard]] Numbers numbers_of_piece(std::uint32_t piece) const {
    Numbers numbers{};
    for (std::size_t k = 0; k < 3; ++k) numbers[k] = number_of(pieces_.mesh.triangles[piece][k]);
    return numbers;
  }

  void add_if_kept(std::uint32_t t) {
    if (tangles_.tangled[t] != 0) return;
    const PatchSides& sides = sides_[tangles_.patch_of[t]];
    if (sides.solid_in_front == sides.solid_behind) return;
    Numbers corners = tangles_.on_grid.triangles[t];
    if ((tangles_.winding[t] > 0) != sides.solid_behind) std::swap(corners[1], corners[2]);
    add(corners, t);
  }

  void add(const Numbers& corners, std::uint32_t triangle) {
    corners_.push_back(corners);
    result_.source.push_back(soup_.triangles[TriangleId(triangle)].source);
  }

  // Whether every edge has two triangles, turned alike.
  bool join_fans() {
    DisjointSets fans(3 * corners_.size());
    bool closed = true;
    const EdgeTable table(corners_);
    table.for_each_edge([&](std::span<const std::uint32_t> sides) {
      closed = closed && sides.size() == 2 &&
               side_start(corners_, sides[0]) != side_start(corners_, sides[1]);
      if (!closed) return;
      fans.join(sides[0], next_side(sides[1]));
      fans.join(next_side(sides[0]), sides[1]);
    });
    if (closed) make_vertices(fans);
    return closed;
  }

  void make_vertices(DisjointSets& fans) {
    std::vector<std::uint32_t> vertex(3 * corners_.size(), kNone);
    for (std::uint32_t t = 0; t < corners_.size(); ++t) {
      IndexTriangle triangle{};
      for (std::uint32_t k = 0; k < 3; ++k) {
        std::uint32_t& number = vertex[fans.root(3 * t + k)];
        if (number == kNone) number = add_point(corners_[t][k]);
        triangle[k] = number;
      }
      result_.mesh.triangles.push_back(triangle);
    }
  }

  std::uint32_t add_point(std::uint32_t number) {
    const auto of_soup = static_cast<std::uint32_t>(soup_.points.size());
    const bool is_input = number < of_soup;
    result_.mesh.points.push_back(is_input ? soup_.points[PointId(number)]
                                           : pieces_.mesh.points[number - of_soup]);
    result_.input_point.push_back(is_input ? 1 : 0);
    return static_cast<std::uint32_t>(result_.mesh.points.size() - 1);
  }

  const CleanSoup& soup_;
  const Tangles& tangles_;
  const std::vector<PatchSides>& sides_;
  const Surface& pieces_;
  std::vector<std::uint32_t> by_place_;  // points of tangled triangles, by their coordinates
  std::vector<Numbers> corners_;
  Surface result_;
};

}  // namespace

std::optional<Surface> sew_pieces(const CleanSoup& soup, const Tangles& tangles,
                                  const std::vector<PatchSides>& sides, const Surface& pieces) {
  return PieceSewer(soup, tangles, sides, pieces).run();
}

}  // namespace meshrepair::internal
