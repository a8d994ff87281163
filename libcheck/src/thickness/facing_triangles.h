// SPDX-License-Identifier: MIT
// The balls that touch a triangle at a point, and what stops their growth.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include <base/raw_vector.h>
#include <check/box_tree.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

// With an area and finite; coordinates are at most 1.
struct MeasuredTriangle {
  std::array<Vec3d, 3> corners;
  Vec3d normal;  // of length 1
  double area = 0;
  std::uint32_t id = 0;  // in the soup
};

// By their corners, the first one first.
[[nodiscard]] bool comes_first(const MeasuredTriangle& a, const MeasuredTriangle& b);

// A triangle faces another one if the cosine between their normals is at most this.
inline constexpr double kOpposite = -0.9;
inline constexpr double kWedge = -0.4;

// Where the balls of a point are, and which triangles stop them.
struct TangentBalls {
  Vec3d point;
  Vec3d normal;        // of the triangle that they touch at the point
  bool in_front;       // of that triangle
  double most_cosine;  // kOpposite or kWedge
};

struct Contact {
  double diameter = 0;
  std::uint32_t triangle = 0;  // a position in FacingTriangles::triangles()
  Vec3d at = Vec3d::Zero();
};

// Where a line meets a triangle: from + t along.
struct Hit {
  double t = 0;
  std::uint32_t triangle = 0;  // a position in FacingTriangles::triangles(); kNone: none
};

class FacingTriangles {
 public:
  // n log n.
  explicit FacingTriangles(std::span<const MeasuredTriangle> triangles);

  // In the order of the tree.
  [[nodiscard]] std::span<const MeasuredTriangle> triangles() const { return triangles_; }

  // What stops the ball before its diameter is `limit`, but for a thousandth of that diameter;
  // nothing where none does. In a round body all triangles stop nearly the same ball, and to
  // compare them all would take the square of their number.
  [[nodiscard]] std::optional<Contact> contact(const TangentBalls& balls, double limit) const;

  // Whether a ball that touches the triangle in this radius around the point may be stopped before
  // its diameter is `limit`.
  [[nodiscard]] bool may_have_contact(const TangentBalls& balls, double radius, double limit) const;

  // The first one for t from `low` to below `high`; without a triangle at `high` where there is
  // none.
  [[nodiscard]] Hit first_hit(const Vec3d& from, const Vec3d& along, double low, double high) const;

  // Whether a triangle within 45 degrees of this direction is in the ball, by more than a
  // thousandth.
  [[nodiscard]] bool has_in_ball(const Vec3d& centre, double radius, const Vec3d& direction) const;

  // The triangle that is nearest to the point of those whose cosine with `normal` is between
  // -most_cosine and most_cosine, but for a thousandth of the distance; kNone where none is nearer
  // than `limit`.
  [[nodiscard]] std::uint32_t nearest_sideways(const Vec3d& point, const Vec3d& normal,
                                               double most_cosine, double limit) const;

 private:
  // The triangles below nodes that `reaches(node)` says yes to, and those above. Of the children of
  // a node the one whose `order(node)` is less is first.
  template <class Reaches, class Order, class Visit>
  void walk(const Reaches& reaches, const Order& order, const Visit& visit) const {
    std::array<std::uint32_t, 40> stack{};  // the tree is balanced, and has 32 levels at most
    std::size_t waiting = 0;
    if (!triangles_.empty()) stack[waiting++] = 0;
    while (waiting > 0) {
      const std::uint32_t n = stack[--waiting];
      if (!reaches(n)) continue;
      const BoxNode& node = tree_.nodes()[n];
      if (node.is_leaf()) {
        for (std::uint32_t i = 0; i < node.count; ++i) visit(node.first + i);
      } else {
        const bool is_right_first = order(node.right) < order(n + 1);
        stack[waiting++] = is_right_first ? n + 1 : node.right;
        stack[waiting++] = is_right_first ? node.right : n + 1;
      }
    }
  }

  RawVector<MeasuredTriangle> triangles_;
  BoxTree tree_;
  // A ball that does not reach the slab reaches none of the triangles.
  struct Slab {
    Vec3d normal;
    double low, high;  // of products with it

    [[nodiscard]] bool is_reached(const Vec3d& centre, double radius) const {
      const double level = normal.dot(centre);
      return level + radius >= low && level - radius <= high;
    }
  };
  [[nodiscard]] Slab slab_of(std::uint32_t first, std::uint32_t last, const Box& normals) const;

  RawVector<Box> normals_;  // of each node
  RawVector<Slab> slabs_;   // likewise
};

}  // namespace meshrepair::internal
