// SPDX-License-Identifier: MIT
// The ball that touches the point p, has its centre at p + r d, and passes through a point q has
//
//   r = |q - p|^2 / (2 (q - p) d)
//
// so the ball that touches a triangle has the least of these. With the plane of the triangle, whose
// normal m is turned so that it points away from p, it is s / (1 + m d), where s is the distance of
// p from the plane; the ball touches the plane at p + r (d + m). If that is not in the triangle,
// the least is on one of its sides. Along a line r is a quotient of a quadratic and a linear
// function, with one minimum where it is positive, so that of the side is the point of it that is
// nearest to the minimum on the line.
#include "facing_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include <base/ids.h>
#include <base/parallel.h>
#include <check/internal/nearest_triangle.h>

namespace meshrepair::internal {
namespace {

// Of the largest coordinate: each one was rounded when it was made, and so are a normal, a
// difference and three products on the way to a distance from a plane. What is nearer is not apart.
constexpr double kPlaneRounding = 0x1p-49;
// Of cosines, and of squares of distances, far above what is rounded: some boxes are opened in
// vain, and whether a ball is found does not depend on the order in which they are.
constexpr double kSlack = 0x1p-40;

// A ball that is larger by a thousandth is as good as the smallest one.
constexpr double kNearEnough = 1 - 0x1p-10;

// Within 45 degrees.
constexpr double kAlong = 0.7;

// Of the size of a triangle: a line that meets an edge of two triangles passes neither by, though
// it is rounded.
constexpr double kRim = 0x1p-20;

constexpr std::size_t kPerTask = 8192;

RawVector<Box> boxes_of(std::span<const MeasuredTriangle> triangles) {
  RawVector<Box> boxes(triangles.size());
  parallel_tasks(boxes.size(), kPerTask, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      boxes[t] = Box();
      for (const Vec3d& p : triangles[t].corners) boxes[t].add(p);
    }
  });
  return boxes;
}

constexpr auto kAnyOrder = [](std::uint32_t) { return 0; };

// The least product of the vector with a point of the box.
double least_product(const Vec3d& v, const Box& box) {
  double least = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = v[static_cast<Eigen::Index>(k)];
    least += x * (x > 0 ? box.low[k] : box.high[k]);
  }
  return least;
}

double most_product(const Vec3d& v, const Box& box) { return -least_product(-v, box); }

// A ball that grows from a point, and the triangle that stops it.
struct Ball {
  std::span<const MeasuredTriangle> triangles;
  Vec3d point;
  Vec3d towards;  // its centre, of length 1
  Contact contact;

  void stop(double diameter, std::uint32_t triangle, const Vec3d& at) {
    const bool is_tie = diameter == contact.diameter;
    if (is_tie && contact.triangle == kNone) return;  // the limit
    if (diameter < contact.diameter ||
        (is_tie && comes_first(triangles[triangle], triangles[contact.triangle]))) {
      contact = {diameter, triangle, at};
    }
  }

  void pass(const Vec3d& q, std::uint32_t triangle) {
    const Vec3d w = q - point;
    const double ahead = w.dot(towards);
    if (ahead > 0) stop(w.squaredNorm() / ahead, triangle, q);
  }

  // See above. With w = a - p and e = b - a, at a + t e the diameter is
  // (w w + 2 t w e + t^2 e e) / (g + h t), where g = w d and h = e d. It is least where the
  // denominator is the root of g^2 + h (h w w - 2 g w e) / e e.
  void pass_side(const Vec3d& a, const Vec3d& b, std::uint32_t triangle) {
    const Vec3d w = a - point, e = b - a;
    const double length = e.squaredNorm();
    const double g = w.dot(towards), h = e.dot(towards);
    const double shift = (h * w.squaredNorm() - 2 * g * w.dot(e)) / length;
    const double root = std::sqrt(std::max(g * g + h * shift, 0.0));
    const double t = g > 0 ? shift / (g + root) : (root - g) / h;
    if (std::isnan(t)) return pass(a, triangle);
    pass(a + std::clamp(t, 0.0, 1.0) * e, triangle);
  }

  // `outward` is the normal of the triangle, turned away from the point.
  void stop_at(std::uint32_t number, const Vec3d& outward) {
    const auto& corners = triangles[number].corners;
    const double apart = (corners[0] - point).dot(outward);
    const double size = std::max(point.cwiseAbs().maxCoeff(), corners[0].cwiseAbs().maxCoeff());
    if (!(apart > kPlaneRounding * size)) return;
    const double radius = apart / (1 + outward.dot(towards));
    if (!(2 * radius <= contact.diameter)) return;
    const Vec3d touched = point + radius * (towards + outward);
    bool is_inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d &u = corners[k], &v = corners[(k + 1) % 3];
      is_inside = is_inside && (v - u).cross(touched - u).dot(triangles[number].normal) >= 0;
    }
    if (is_inside) return stop(2 * radius, number, touched);
    for (std::size_t k = 0; k < 3; ++k) pass_side(corners[k], corners[(k + 1) % 3], number);
  }
};

// A part of a line, and the boxes and triangles that it meets.
struct Beam {
  Vec3d from, along;
  double low;
  Hit first;  // without a triangle at the end of the part

  [[nodiscard]] bool meets(const Box& box) const {
    double near = low, far = first.t;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      if (along[axis] == 0) {
        if (from[axis] < box.low[k] || from[axis] > box.high[k]) return false;
        continue;
      }
      const double a = (box.low[k] - from[axis]) / along[axis];
      const double b = (box.high[k] - from[axis]) / along[axis];
      near = std::max(near, std::min(a, b));
      far = std::min(far, std::max(a, b));
    }
    return near <= far;
  }

  // Moeller and Trumbore, Fast, minimum storage ray-triangle intersection (1997).
  void stop_at(const MeasuredTriangle& triangle, std::uint32_t number) {
    const auto& [a, b, c] = triangle.corners;
    const Vec3d ab = b - a, ac = c - a;
    const Vec3d across = along.cross(ac);
    const double volume = ab.dot(across);
    if (volume == 0) return;
    const Vec3d w = from - a;
    const double u = w.dot(across) / volume;
    const Vec3d turned = w.cross(ab);
    const double v = along.dot(turned) / volume;
    if (!(u >= -kRim && v >= -kRim && u + v <= 1 + kRim)) return;
    const double t = ac.dot(turned) / volume;
    if (t >= low && t < first.t) first = {t, number};
  }
};

}  // namespace

bool comes_first(const MeasuredTriangle& a, const MeasuredTriangle& b) {
  const auto is_less = [](const Vec3d& p, const Vec3d& q) {
    return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
  };
  return std::lexicographical_compare(a.corners.begin(), a.corners.end(), b.corners.begin(),
                                      b.corners.end(), is_less);
}

FacingTriangles::FacingTriangles(std::span<const MeasuredTriangle> triangles)
    : triangles_(triangles.size()),
      tree_(boxes_of(triangles)),
      normals_(tree_.nodes().size()),
      slabs_(tree_.nodes().size()) {
  parallel_tasks(triangles.size(), kPerTask, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      triangles_[t] = triangles[tree_.order()[t]];
    }
  });
  const auto nodes = tree_.nodes();
  for (std::size_t n = nodes.size(); n-- > 0;) {  // children come behind their parent
    normals_[n] = Box();
    if (nodes[n].is_leaf()) {
      for (std::uint32_t i = 0; i < nodes[n].count; ++i) {
        normals_[n].add(triangles_[nodes[n].first + i].normal);
      }
    } else {
      normals_[n].add(normals_[n + 1]);
      normals_[n].add(normals_[nodes[n].right]);
    }
  }
  // Of each node the first triangle below it, and the one behind the last.
  std::vector<std::array<std::uint32_t, 2>> range(nodes.size());
  for (std::size_t n = nodes.size(); n-- > 0;) {
    range[n] = nodes[n].is_leaf() ? std::array{nodes[n].first, nodes[n].first + nodes[n].count}
                                  : std::array{range[n + 1][0], range[nodes[n].right][1]};
  }
  parallel_tasks(nodes.size(), kPerTask, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t n = first; n < last; ++n) {
      slabs_[n] = slab_of(range[n][0], range[n][1], normals_[n]);
    }
  });
}

// Along the middle of the normals.
FacingTriangles::Slab FacingTriangles::slab_of(std::uint32_t first, std::uint32_t last,
                                               const Box& normals) const {
  Slab slab{Vec3d::Zero(), std::numeric_limits<double>::infinity(),
            -std::numeric_limits<double>::infinity()};
  for (std::size_t k = 0; k < 3; ++k) {
    slab.normal[static_cast<Eigen::Index>(k)] = normals.low[k] + normals.high[k];
  }
  const double length = slab.normal.norm();
  if (!(length > 0)) return {Vec3d::Zero(), 0, 0};
  slab.normal /= length;
  for (std::uint32_t t = first; t < last; ++t) {
    for (const Vec3d& p : triangles_[t].corners) {
      const double level = slab.normal.dot(p);
      slab.low = std::min(slab.low, level);
      slab.high = std::max(slab.high, level);
    }
  }
  slab.low -= kPlaneRounding;
  slab.high += kPlaneRounding;
  return slab;
}

std::optional<Contact> FacingTriangles::contact(const TangentBalls& balls, double limit) const {
  const Vec3d towards = balls.in_front ? balls.normal : Vec3d(-balls.normal);
  Ball ball{triangles_, balls.point, towards, {limit, kNone, {}}};
  double radius = 0.5 * limit * kNearEnough;
  Vec3d centre = balls.point + radius * towards;
  const auto reaches = [&](std::uint32_t n) {
    return tree_.nodes()[n].box.squared_distance(centre) < radius * radius &&
           least_product(balls.normal, normals_[n]) <= balls.most_cosine + kSlack &&
           slabs_[n].is_reached(centre, radius);
  };
  const auto order = [&](std::uint32_t n) {
    return tree_.nodes()[n].box.squared_distance(balls.point);
  };
  walk(reaches, order, [&](std::uint32_t t) {
    const MeasuredTriangle& triangle = triangles_[t];
    if (!(balls.normal.dot(triangle.normal) <= balls.most_cosine)) return;
    const double before = ball.contact.diameter;
    ball.stop_at(t, balls.in_front ? Vec3d(-triangle.normal) : triangle.normal);
    if (ball.contact.diameter == before) return;
    radius = 0.5 * ball.contact.diameter * kNearEnough;
    centre = balls.point + radius * towards;
  });
  if (ball.contact.diameter >= limit) return std::nullopt;
  return ball.contact;
}

bool FacingTriangles::may_have_contact(const TangentBalls& balls, double radius,
                                       double limit) const {
  const Vec3d towards = balls.in_front ? balls.normal : Vec3d(-balls.normal);
  const double reach = (radius + limit) * (1 + kSlack);
  const double level = balls.point.dot(towards);
  bool found = false;
  const auto near = [&](const Box& box) {
    return box.squared_distance(balls.point) <= reach * reach &&
           least_product(towards, box) <= level + limit + kSlack &&
           most_product(towards, box) >= level - kSlack;
  };
  const auto reaches = [&](std::uint32_t n) {
    return !found && near(tree_.nodes()[n].box) &&
           least_product(balls.normal, normals_[n]) <= balls.most_cosine + kSlack;
  };
  walk(reaches, kAnyOrder, [&](std::uint32_t t) {
    if (found || !(balls.normal.dot(triangles_[t].normal) <= balls.most_cosine)) return;
    Box box;
    for (const Vec3d& p : triangles_[t].corners) box.add(p);
    found = near(box);
  });
  return found;
}

Hit FacingTriangles::first_hit(const Vec3d& from, const Vec3d& along, double low,
                               double high) const {
  Beam beam{from, along, low, {high, kNone}};
  walk([&](std::uint32_t n) { return beam.meets(tree_.nodes()[n].box); }, kAnyOrder,
       [&](std::uint32_t t) { beam.stop_at(triangles_[t], t); });
  return beam.first;
}

bool FacingTriangles::has_in_ball(const Vec3d& centre, double radius,
                                  const Vec3d& direction) const {
  const double reach = radius * kNearEnough;
  bool found = false;
  walk(
      [&](std::uint32_t n) {
        return !found && tree_.nodes()[n].box.squared_distance(centre) < reach * reach &&
               most_product(direction, normals_[n]) >= kAlong - kSlack &&
               slabs_[n].is_reached(centre, reach);
      },
      kAnyOrder,
      [&](std::uint32_t t) {
        found = found || (direction.dot(triangles_[t].normal) >= kAlong &&
                          squared_distance(centre, triangles_[t].corners) < reach * reach);
      });
  return found;
}

std::uint32_t FacingTriangles::nearest_sideways(const Vec3d& point, const Vec3d& normal,
                                                double most_cosine, double limit) const {
  double square = limit * limit;
  std::uint32_t nearest = kNone;
  const auto reaches = [&](std::uint32_t n) {
    return tree_.nodes()[n].box.squared_distance(point) < square * kNearEnough * kNearEnough &&
           slabs_[n].is_reached(point, std::sqrt(square) * kNearEnough) &&
           least_product(normal, normals_[n]) <= most_cosine + kSlack &&
           most_product(normal, normals_[n]) >= -most_cosine - kSlack;
  };
  const auto order = [&](std::uint32_t n) { return tree_.nodes()[n].box.squared_distance(point); };
  walk(reaches, order, [&](std::uint32_t t) {
    if (!(std::abs(normal.dot(triangles_[t].normal)) <= most_cosine)) return;
    const double found = squared_distance(point, triangles_[t].corners);
    const bool is_tie = found == square && nearest != kNone;
    if (found < square || (is_tie && comes_first(triangles_[t], triangles_[nearest]))) {
      square = found;
      nearest = t;
    }
  });
  return nearest;
}

}  // namespace meshrepair::internal
