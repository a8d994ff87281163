// SPDX-License-Identifier: MIT
#include "triangulate/planar_mesh.h"

#include <array>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "each_seed.h"
#include "random_geometry.h"

namespace meshrepair {
namespace {

using internal::PlanarMesh;
using testing::Random;

constexpr std::int32_t kSize = 40;

// A triangle in a plane that is tilted, and points of a lattice in it.
class Filled {
 public:
  Filled() : mesh_(planes_, false) {
    at_.reserve(200);
    plane_ = planes_.append(plane_through(place(0, 0), place(kSize, 0), place(0, kSize)));
    mesh_.reset(plane_, 1);
    for (const auto& [x, y] : {std::pair(0, 0), std::pair(kSize, 0), std::pair(0, kSize)}) {
      add(x, y);
      (void)mesh_.add_vertex(at_.back());
    }
    (void)mesh_.add_triangle({0, 1, 2});
    note(0, 0, 0);
    note(1, kSize, 0);
    note(2, 0, kSize);
  }

  bool insert(std::int32_t x, std::int32_t y) {
    std::uint32_t vertex = 0;
    add(x, y);
    const bool inserted = mesh_.insert_vertex(at_.back(), vertex);
    if (inserted) {
      EXPECT_EQ(vertex, vertices_++);
    }
    return inserted;
  }

  // The side of the outline that starts at a vertex; the new one follows it.
  std::uint32_t split(std::uint32_t from, std::int32_t x, std::int32_t y) {
    add(x, y);
    note(vertices_, x, y);
    const std::uint32_t vertex = mesh_.split_outline(mesh_.outline_from(from), at_.back());
    EXPECT_EQ(vertex, vertices_++);
    return vertex;
  }

  // Twice the area of all triangles, each of which is to turn left.
  std::int64_t area() {
    std::int64_t sum = 0;
    mesh_.for_each_triangle([&](const std::array<std::uint32_t, 3>& corners, const auto&) {
      const auto& [a, b] = flat(corners[0]);
      const auto& [c, d] = flat(corners[1]);
      const auto& [e, f] = flat(corners[2]);
      const std::int64_t part = (c - a) * (f - b) - (d - b) * (e - a);
      EXPECT_GT(part, 0);
      sum += part;
    });
    return sum;
  }

  // Each side has the neighbour's as its own neighbour.
  void expect_joined() {
    for (std::uint32_t s = 0; s < mesh_.slots(); ++s) {
      const std::uint32_t other = mesh_.across(s);
      if (other == PlanarMesh::kNone) continue;
      EXPECT_EQ(mesh_.across(other), s);
      EXPECT_EQ(mesh_.vertex_at(s), mesh_.vertex_at(internal::next_slot(other)));
      EXPECT_EQ(mesh_.mark_of(s), mesh_.mark_of(other));
    }
  }

  bool has_marked_edge(std::uint32_t a, std::uint32_t b) {
    for (std::uint32_t s = 0; s < mesh_.slots(); ++s) {
      const std::uint32_t from = mesh_.vertex_at(s);
      const std::uint32_t to = mesh_.vertex_at(internal::next_slot(s));
      if (std::minmax(from, to) == std::minmax(a, b)) return mesh_.mark_of(s) != PlanarMesh::kNone;
    }
    return false;
  }

  PlanarMesh& mesh() { return mesh_; }
  std::uint32_t vertices() const { return vertices_; }

 private:
  static GridPoint place(std::int32_t x, std::int32_t y) { return {x, y, 2 * x - 3 * y + 7}; }
  void add(std::int32_t x, std::int32_t y) { at_.push_back(lattice_point(place(x, y))); }
  // Vertices that were not inserted have no number.
  std::pair<std::int64_t, std::int64_t> flat(std::uint32_t vertex) {
    const GridPoint p = points_of_[vertex];
    return {p.x, p.y};
  }

 public:
  void note(std::uint32_t vertex, std::int32_t x, std::int32_t y) {
    if (points_of_.size() <= vertex) points_of_.resize(vertex + 1);
    points_of_[vertex] = place(x, y);
  }

 private:
  PlaneTable planes_;
  PlaneId plane_;
  PlanarMesh mesh_;
  std::vector<Point> at_;
  std::vector<GridPoint> points_of_;
  std::uint32_t vertices_ = 3;
};

TEST(PlanarMesh, PointsAreInsertedOnce) {
  for_each_seed(200, [&](std::uint64_t seed) {
    Random random(seed);
    Filled filled;
    std::set<std::pair<std::int32_t, std::int32_t>> taken = {{0, 0}, {kSize, 0}, {0, kSize}};
    for (int i = 0; i < 60; ++i) {
      const std::int32_t x = random.integer(-2, kSize), y = random.integer(-2, kSize);
      const bool inside = x >= 0 && y >= 0 && x + y <= kSize;
      const bool is_new = inside && taken.insert({x, y}).second;
      const std::uint32_t next = filled.vertices();
      EXPECT_EQ(filled.insert(x, y), is_new);
      if (is_new) filled.note(next, x, y);
    }
    EXPECT_EQ(filled.area(), std::int64_t{kSize} * kSize);
    filled.expect_joined();
  });
}

TEST(PlanarMesh, SidesOfTheOutlineAreSplitInOrder) {
  Filled filled;
  std::uint32_t on_first = 0, on_second = 1, on_third = 2;
  for (std::int32_t i = 1; i < kSize; ++i) {
    on_first = filled.split(on_first, i, 0);
    on_second = filled.split(on_second, kSize - i, i);
    on_third = filled.split(on_third, 0, kSize - i);
  }
  EXPECT_EQ(filled.area(), std::int64_t{kSize} * kSize);
  filled.expect_joined();
}

// From each point to the next but one on a convex curve, where these do not cross.
TEST(PlanarMesh, EdgesAreInsertedWhereNothingIsInBetween) {
  for_each_seed(200, [&](std::uint64_t seed) {
    Random random(seed);
    Filled filled;
    std::vector<std::pair<std::int32_t, std::int32_t>> places = {{0, 0}, {kSize, 0}, {0, kSize}};
    for (int i = 0; i < 30; ++i) {
      const std::int32_t x = random.integer(0, kSize), y = random.integer(0, kSize - x);
      const std::uint32_t next = filled.vertices();
      if (!filled.insert(x, y)) continue;
      filled.note(next, x, y);
      places.emplace_back(x, y);
    }
    const auto turn = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      const auto [ax, ay] = places[a];
      const auto [bx, by] = places[b];
      const auto [cx, cy] = places[c];
      const int area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
      return (area > 0) - (area < 0);
    };
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (int i = 0; i < 40; ++i) {
      const auto last = static_cast<std::int32_t>(places.size() - 1);
      const auto a = static_cast<std::uint32_t>(random.integer(0, last));
      const auto b = static_cast<std::uint32_t>(random.integer(0, last));
      if (a == b) continue;
      bool free = true;
      for (std::uint32_t p = 0; p < places.size(); ++p) {
        if (p == a || p == b || turn(a, b, p) != 0) continue;
        const auto [px, py] = places[p];
        const auto dot = (px - places[a].first) * (px - places[b].first) +
                         (py - places[a].second) * (py - places[b].second);
        free = free && dot > 0;  // not between them
      }
      for (const auto& [c, d] : edges) {
        const bool cross = turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
        free = free && !cross;
      }
      if (!free) {
        continue;
      }
      EXPECT_TRUE(filled.mesh().insert_edge(a, b, 5));
      edges.emplace_back(a, b);
    }
    for (const auto& [a, b] : edges) EXPECT_TRUE(filled.has_marked_edge(a, b));
    EXPECT_EQ(filled.area(), std::int64_t{kSize} * kSize);
    filled.expect_joined();
  });
}

TEST(PlanarMesh, NoEdgeIsInsertedThroughAVertexOrAMarkedEdge) {
  Filled filled;
  for (const auto& [x, y] : {std::pair(5, 5), std::pair(10, 10), std::pair(15, 15),
                             std::pair(5, 15), std::pair(8, 20)}) {
    ASSERT_TRUE(filled.insert(x, y));
  }
  EXPECT_FALSE(filled.mesh().insert_edge(3, 5, 0));  // through 4
  EXPECT_TRUE(filled.mesh().insert_edge(3, 4, 0));
  EXPECT_TRUE(filled.mesh().insert_edge(6, 4, 0));
  EXPECT_FALSE(filled.mesh().insert_edge(3, 7, 0));  // over 4 - 6
}

}  // namespace
}  // namespace meshrepair
