// Around every corner of a tangled triangle all is cut, so the extraction has told there which fans
// of triangles are one vertex: also at edges along which solids touch. What it made of triangles
// that are not tangled serves to take over these vertices; it ends anywhere else. At all other
// points fans of triangles are joined over their edges, and each is a vertex.
#include "sew_pieces.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include <base/disjoint_sets.h>
#include <base/ids.h>
#include <mesh/edge_table.h>

namespace meshrepair::internal {
namespace {

class PieceSewer {
 public:
  PieceSewer(const CleanSoup& soup, const Tangles& tangles, const std::vector<PatchSides>& sides,
             const Surface& pieces)
      : soup_(soup), tangles_(tangles), sides_(sides), pieces_(pieces) {}

  std::optional<Surface> run() {
    mark_points_of_tangles();
    find_shared_corners();
    std::uint32_t next = 0;
    for (std::uint32_t i = 0; i < pieces_.mesh.triangles.size(); ++i) {
      const std::uint32_t source = pieces_.source[i];
      if (is_set_aside(source)) continue;
      for (; next < source && source != Surface::kNoSource; ++next) add_if_kept(next);
      IndexTriangle corners = pieces_.mesh.triangles[i];
      for (std::uint32_t& corner : corners) corner += first_of_pieces();
      add(corners, source);
    }
    for (; next < tangles_.tangled.size(); ++next) add_if_kept(next);
    if (!complete_ || !join_fans()) return std::nullopt;
    return std::move(result_);
  }

 private:
  // Corners have the numbers of the soup's points, or of the pieces' points after these.
  [[nodiscard]] std::uint32_t first_of_pieces() const {
    return static_cast<std::uint32_t>(soup_.points.size());
  }

  [[nodiscard]] bool is_set_aside(std::uint32_t source) const {
    return source != Surface::kNoSource && tangles_.tangled[source] == 0;
  }

  void mark_points_of_tangles() {
    of_tangles_.assign(soup_.points.size(), 0);
    for (std::size_t t = 0; t < tangles_.tangled.size(); ++t) {
      if (tangles_.tangled[t] == 0) continue;
      for (const std::uint32_t p : tangles_.on_grid.triangles[t]) of_tangles_[p] = 1;
    }
  }

  // Of triangles that are not tangled, those that are points of tangles, in the pieces of them.
  void find_shared_corners() {
    for (std::uint32_t i = 0; i < pieces_.mesh.triangles.size(); ++i) {
      const std::uint32_t source = pieces_.source[i];
      if (!is_set_aside(source)) continue;
      for (const std::uint32_t v : pieces_.mesh.triangles[i]) {
        if (pieces_.input_point[v] == 0) continue;
        for (std::uint32_t k = 0; k < 3; ++k) {
          const std::uint32_t p = tangles_.on_grid.triangles[source][k];
          if (of_tangles_[p] == 0 || soup_.points[PointId(p)] != pieces_.mesh.points[v]) continue;
          shared_.push_back({3 * source + k, v});
        }
      }
    }
    std::sort(shared_.begin(), shared_.end());
  }

  // Of corner k of a triangle that is not tangled.
  std::uint32_t number_of(std::uint32_t t, std::uint32_t k) {
    const std::uint32_t p = tangles_.on_grid.triangles[t][k];
    if (of_tangles_[p] == 0) return p;
    const auto found = std::lower_bound(shared_.begin(), shared_.end(), std::pair(3 * t + k, 0u));
    complete_ &= found != shared_.end() && found->first == 3 * t + k;
    return complete_ ? first_of_pieces() + found->second : p;
  }

  void add_if_kept(std::uint32_t t) {
    if (tangles_.tangled[t] != 0) return;
    const PatchSides& sides = sides_[tangles_.patch_of[t]];
    if (sides.solid_in_front == sides.solid_behind) return;
    IndexTriangle corners = {number_of(t, 0), number_of(t, 1), number_of(t, 2)};
    if ((tangles_.winding[t] > 0) != sides.solid_behind) std::swap(corners[1], corners[2]);
    add(corners, t);
  }

  void add(const IndexTriangle& corners, std::uint32_t triangle) {
    corners_.push_back(corners);
    static_assert(Surface::kNoSource == Triangle::kNoSource);
    result_.source.push_back(
        triangle == Surface::kNoSource ? triangle : soup_.triangles[TriangleId(triangle)].source);
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
    const bool of_soup = number < first_of_pieces();
    const std::uint32_t piece = number - first_of_pieces();
    result_.mesh.points.push_back(of_soup ? soup_.points[PointId(number)]
                                          : pieces_.mesh.points[piece]);
    result_.input_point.push_back(of_soup || pieces_.input_point[piece] != 0 ? 1 : 0);
    return static_cast<std::uint32_t>(result_.mesh.points.size() - 1);
  }

  const CleanSoup& soup_;
  const Tangles& tangles_;
  const std::vector<PatchSides>& sides_;
  const Surface& pieces_;
  std::vector<char> of_tangles_;  // of each point of the soup: a corner of a tangled triangle
  // Corner k of triangle t as 3 t + k, and the point of the pieces that it is; sorted.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> shared_;
  bool complete_ = true;  // all shared corners were found
  std::vector<IndexTriangle> corners_;
  Surface result_;
};

}  // namespace

std::optional<Surface> sew_pieces(const CleanSoup& soup, const Tangles& tangles,
                                  const std::vector<PatchSides>& sides, const Surface& pieces) {
  return PieceSewer(soup, tangles, sides, pieces).run();
}

}  // namespace meshrepair::internal
