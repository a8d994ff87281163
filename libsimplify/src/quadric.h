// SPDX-License-Identifier: MIT
// The sum of weighted squares of distances from planes.
#pragma once

#include <algorithm>

#include <Eigen/Core>
#include <Eigen/LU>

#include <base/vec3.h>

namespace meshrepair::internal {

// weight * distance^2 of a place from planes: x A x + 2 b x + c.
class Quadric {
 public:
  // `normal` has length 1; the plane goes through `at`.
  void add_plane(const Vec3d& normal, const Vec3d& at, double weight) {
    add_square(normal, -normal.dot(at), weight);
    weight_ += weight;
  }

  // factor * (g x + offset)^2, of no weight.
  void add_square(const Vec3d& g, double offset, double factor) {
    xx_ += factor * g.x() * g.x();
    xy_ += factor * g.x() * g.y();
    xz_ += factor * g.x() * g.z();
    yy_ += factor * g.y() * g.y();
    yz_ += factor * g.y() * g.z();
    zz_ += factor * g.z() * g.z();
    b_ += factor * offset * g;
    c_ += factor * offset * offset;
  }

  void add_weight(double weight) { weight_ += weight; }

  void add(const Quadric& other) {
    add_squares(other);
    weight_ += other.weight_;
  }

  // Without its weight.
  void add_squares(const Quadric& other) {
    xx_ += other.xx_;
    xy_ += other.xy_;
    xz_ += other.xz_;
    yy_ += other.yy_;
    yz_ += other.yz_;
    zz_ += other.zz_;
    b_ += other.b_;
    c_ += other.c_;
  }

  [[nodiscard]] double weight() const { return weight_; }

  // Rounding may leave less than nothing: then 0.
  [[nodiscard]] double at(const Vec3d& x) const {
    return std::max(0.0, x.dot(times(x)) + 2 * b_.dot(x) + c_);
  }

  // Of a plane.
  struct Plane {
    Vec3d normal = Vec3d::Zero();  // of any length; none: there is no plane
    double offset = 0;             // of x on it: normal x = offset
  };

  // Where it is least on the plane; in directions in which it hardly changes, as `near` is. What is
  // pulled there in the others is taken back step by step.
  [[nodiscard]] Vec3d least_near(const Vec3d& near, const Plane& plane) const {
    constexpr double kHardly = 1e-5;
    constexpr int kSteps = 3;
    const double pull = kHardly * (xx_ + yy_ + zz_);
    if (!(pull > 0)) return near;
    Eigen::Matrix3d a;
    a << xx_ + pull, xy_, xz_, xy_, yy_ + pull, yz_, xz_, yz_, zz_ + pull;
    const Eigen::Matrix3d inverse = a.inverse();
    Vec3d x = near;
    for (int step = 0; step < kSteps; ++step) x -= inverse * (times(x) + b_);
    const Vec3d across = inverse * plane.normal;
    const double size = plane.normal.dot(across);
    if (size > 0) x += (plane.offset - plane.normal.dot(x)) / size * across;
    return x;
  }

 private:
  [[nodiscard]] Vec3d times(const Vec3d& x) const {
    return {xx_ * x.x() + xy_ * x.y() + xz_ * x.z(), xy_ * x.x() + yy_ * x.y() + yz_ * x.z(),
            xz_ * x.x() + yz_ * x.y() + zz_ * x.z()};
  }

  double xx_ = 0, xy_ = 0, xz_ = 0, yy_ = 0, yz_ = 0, zz_ = 0;
  Vec3d b_ = Vec3d::Zero();
  double c_ = 0;
  double weight_ = 0;
};

}  // namespace meshrepair::internal
