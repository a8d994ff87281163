// SPDX-License-Identifier: MIT
// Moves points of a mesh onto neighbours, the nearest first, within a bound.
#pragma once

#include <cstdint>
#include <limits>
#include <queue>
#include <span>
#include <vector>

#include <base/progress.h>
#include <check/internal/star_distance.h>
#include <mesh/internal/collapsible_mesh.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

// One run over all points that may go: see simplify_cuts(). It looks at distances and at the
// manifold alone, not at what meets.
class CutSimplifier {
 public:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  // What triangles carry, which is another function of the place in each source.
  struct Carried {
    std::span<const std::uint32_t> source;  // of each triangle of the mesh
    std::span<const double> reach;          // SimplifyOptions has it
  };

  // `stays` has a flag for each point, `within` how far the surface around it may be moved; nothing
  // is owned.
  CutSimplifier(const TriangleSoup& mesh, const std::vector<char>& stays,
                const std::vector<double>& within, const Carried& carried,
                ProgressObserver* progress);

  // Until nothing can be moved any more. Throws Cancelled.
  void run();

  // Takes back the moves of points that are to stay by now, and those that were made on what these
  // had changed, the last first. What is left is as if they had never been made. After that run()
  // looks again at what is around them.
  void take_back();

  [[nodiscard]] const CollapsibleMesh& mesh() const { return mesh_; }
  [[nodiscard]] bool has_moved(std::uint32_t point) const { return moved_onto_[point] != kNone; }
  // Where each point is now: where it was, if it has not moved.
  [[nodiscard]] std::vector<std::uint32_t> places() const;
  // The point whose move changed the triangle last, or kNone.
  [[nodiscard]] std::uint32_t last_moved(std::uint32_t triangle) const {
    return last_moved_[triangle];
  }
  // No point of the mesh is farther from the one at first.
  [[nodiscard]] double distance() const;

 private:
  static constexpr double kInfinite = std::numeric_limits<double>::infinity();

  struct Move {
    double distance = kInfinite;  // of the new triangles from the mesh at first
    double cost = kInfinite, length = kInfinite;
    std::uint32_t point = kNone, target = kNone;
    std::uint32_t version = 0;  // of the point's star

    // Of a queue whose top is the largest.
    bool operator<(const Move& other) const;
  };

  // A triangle that a move changed, and what was known of it before.
  struct Change {
    double distance;
    std::uint32_t last_moved;
    std::uint32_t triangle;
  };

  // A move that was made: its changes, and the points whose moves it builds on, are those from here
  // to the next one's.
  struct Made {
    std::uint32_t point;
    std::size_t first_change, first_base;
  };

  // Puts the best move of the point into the queue, if it has one.
  void consider(std::uint32_t point);
  // Until all moves that are known have been made.
  void postpone(std::uint32_t point);
  [[nodiscard]] bool may_move(std::size_t to, double least_height);
  [[nodiscard]] double height_to_keep(double within) const;
  void find_borders();
  [[nodiscard]] double reach_of_star() const;
  [[nodiscard]] double border_shift(std::size_t to) const;
  void make(const Move& move);
  void remember(const Move& move, std::size_t to);
  void look_again(std::uint32_t point);
  [[nodiscard]] std::vector<char> find_moves_to_take_back() const;
  void take_back(const Made& made, std::size_t end_of_changes);
  void forget_taken_back(const std::vector<char>& is_taken_back);

  const std::vector<Vec3d>& points_;
  const std::vector<char>& stays_;
  const std::vector<double>& within_;
  const Carried carried_;
  CancelCheck cancel_;
  CollapsibleMesh mesh_;
  std::vector<std::uint32_t> version_;
  std::vector<char> waits_;                // of each point, whether it is postponed
  std::vector<double> distance_;           // of each triangle from the mesh at first, at most
  std::vector<std::uint32_t> moved_onto_;  // of each point, the neighbour, or kNone
  std::vector<Made> made_;                 // in their order
  std::vector<Change> changes_;
  std::vector<std::uint32_t> bases_;
  std::vector<std::uint32_t> last_moved_;  // of each triangle, the point that changed it last
  std::priority_queue<Move> queue_;
  std::vector<std::uint32_t> to_consider_;  // when running starts
  PointStar star_;
  std::vector<Vec3d> link_;
  std::vector<std::size_t> borders_;  // in the link, where sources meet in the star
  std::vector<std::uint32_t> around_;
  StarDistance star_distance_;
};

}  // namespace meshrepair::internal
