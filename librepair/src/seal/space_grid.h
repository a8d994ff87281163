// SPDX-License-Identifier: MIT
// Space around a surface as equal cubes, as far as they are near it.
//
// Cubes are made in bricks of 8 x 8 x 8, and only those bricks that come near a triangle. All
// others are far from all triangles, and each of them is one node. A grid of narrow places has the
// bricks around these alone, and knows of no others.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <base/ids.h>
#include <base/internal/hash_index.h>
#include <base/progress.h>
#include <check/internal/nearest_triangle.h>
#include <check/soup_rays.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

using CubePlace = std::array<std::int32_t, 3>;

class SpaceGrid {
 public:
  static constexpr std::int32_t kBrick = 8;
  static constexpr std::uint32_t kCubes = kBrick * kBrick * kBrick;

  // Cubes with sides of `step`, exact distances up to `reach`. The soup is finite and outlives
  // this. Nothing is known yet of how far cubes are from triangles: see measure().
  SpaceGrid(const TriangleSoup& soup, double step, double reach, ProgressObserver* progress);

  // The same around places where triangles that face each other are less than `width` apart; twice
  // `reach` is more than that. Nothing where that takes more cubes than `most_cubes`.
  [[nodiscard]] static std::optional<SpaceGrid> of_narrow_places(const TriangleSoup& soup,
                                                                 double step, double reach,
                                                                 double width,
                                                                 std::size_t most_cubes,
                                                                 ProgressObserver* progress);

  // How many cubes there are.
  [[nodiscard]] std::size_t cubes() const { return kCubes * refined_.size(); }
  // Finds the distances from the centres of all cubes to the nearest triangle: those of cubes that
  // triangles pass exactly, of others from triangles that are nearest to their neighbours.
  void measure(ProgressObserver* progress);

  // A node is a cube or a far brick. Cubes come first.
  [[nodiscard]] std::size_t nodes() const { return cubes() + bricks_.size(); }
  // All space is in nodes, and not narrow places alone.
  [[nodiscard]] bool is_whole() const { return !bricks_.empty(); }
  [[nodiscard]] bool is_cube(std::uint32_t node) const { return node < cubes(); }
  // A brick in the corner of space, which nothing is near.
  [[nodiscard]] std::uint32_t outermost() const { return static_cast<std::uint32_t>(cubes()); }
  // Whether there are cubes for all that is up to a brick away.
  [[nodiscard]] bool is_amid(std::uint32_t cube) const {
    return is_whole() || is_narrow_[cube / kCubes] != 0;
  }
  // What the place lies in; kNone: beyond what there is.
  [[nodiscard]] std::uint32_t node_at(const CubePlace& place) const;
  [[nodiscard]] std::uint32_t node_around(const Vec3d& point) const;
  [[nodiscard]] CubePlace place_of(std::uint32_t cube) const;
  [[nodiscard]] Vec3d centre(std::uint32_t node) const;
  // The corner of the cube at this place with the lowest coordinates.
  [[nodiscard]] Vec3d corner(const CubePlace& place) const;
  // Of the centre from the nearest triangle; infinite if it is beyond the reach.
  [[nodiscard]] double clearance(std::uint32_t node) const;
  [[nodiscard]] double step() const { return step_; }
  // Of all triangles.
  [[nodiscard]] std::vector<Corners> corners() const;

  // Calls visit(node) for all nodes that have a face in common with this one; some may come often.
  template <class Visit>
  void visit_neighbours(std::uint32_t node, Visit visit) const;

 private:
  using Brick = std::array<std::int32_t, 3>;

  // Without bricks.
  SpaceGrid(const TriangleSoup& soup, double step, double reach);
  [[nodiscard]] std::uint32_t refined_at(std::uint64_t number) const;
  void refine_around(const std::vector<Brick>& narrow);
  void measure_all(ProgressObserver* progress);
  void measure_from(const CubePlace& place, std::uint32_t triangle);
  [[nodiscard]] std::uint64_t number_of(const Brick& brick) const;
  [[nodiscard]] Brick brick_of(std::uint64_t number) const;
  // Calls visit_brick(brick) for bricks that the triangle is within the reach of.
  template <class Visit>
  void descend(std::uint32_t triangle, const CubePlace& low, std::int32_t side, double reach,
               std::int32_t smallest, Visit& visit) const;
  template <class Visit>
  void visit_near(std::uint32_t triangle, double reach, std::int32_t smallest, Visit visit) const;
  void find_refined(ProgressObserver* progress);
  void propagate(ProgressObserver* progress);
  [[nodiscard]] float squared_distance_to(std::uint32_t cube, std::uint32_t triangle) const;

  const TriangleSoup* soup_;
  double step_, reach_;
  Vec3d low_ = Vec3d::Zero();
  Brick size_ = {0, 0, 0};
  std::vector<std::uint32_t> bricks_;   // of each brick its place in refined_; kNone: it is far
  std::vector<std::uint64_t> refined_;  // numbers of bricks, ascending
  HashIndex refined_of_{0};             // of narrow places: positions in refined_
  std::vector<char> is_narrow_;         // of these
  std::vector<float> squared_;          // of each cube
  std::vector<std::uint32_t> nearest_;
};

// Whether nothing is between the centres of two cubes. `rays` are of the grid's surface.
[[nodiscard]] bool is_free_way(const SpaceGrid& grid, const SoupRays& rays, std::uint32_t a,
                               std::uint32_t b);

template <class Visit>
void SpaceGrid::visit_neighbours(std::uint32_t node, Visit visit) const {
  const std::int32_t side = is_cube(node) ? 1 : kBrick;
  CubePlace low{};
  if (is_cube(node)) {
    low = place_of(node);
  } else {
    const Brick brick = brick_of(node - cubes());
    for (std::size_t k = 0; k < 3; ++k) low[k] = kBrick * brick[k];
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const std::int32_t beside : {-1, side}) {
      CubePlace at = low;
      at[axis] += beside;
      const std::uint32_t first = node_at(at);
      if (first == kNone) continue;
      if (side == 1 || !is_cube(first)) {
        visit(first);
        continue;
      }
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      for (std::int32_t i = 0; i < side; ++i) {
        for (std::int32_t j = 0; j < side; ++j) {
          CubePlace other = at;
          other[u] += i;
          other[v] += j;
          visit(node_at(other));
        }
      }
    }
  }
}

}  // namespace meshrepair::internal
