// SPDX-License-Identifier: MIT
#include "value_quadrics.h"

#include <Eigen/Geometry>

namespace meshrepair::internal {

ValueQuadrics::ValueQuadrics(std::size_t points, std::size_t components)
    : components_(components), squares_(points), sums_(points * components) {}

void ValueQuadrics::add_triangle(std::uint32_t point, const std::array<Vec3d, 3>& corners,
                                 std::span<const double> values, double weight) {
  const Vec3d ab = corners[1] - corners[0], ac = corners[2] - corners[0];
  const Vec3d normal = ab.cross(ac);
  const double size = normal.squaredNorm();
  if (!(size > 0)) return;
  const Vec3d of_b = ac.cross(normal) / size, of_c = normal.cross(ab) / size;
  squares_[point].add_weight(weight);
  for (std::size_t i = 0; i < components_; ++i) {
    const double a = values[i], b = values[components_ + i], c = values[2 * components_ + i];
    const Vec3d gradient = (b - a) * of_b + (c - a) * of_c;
    const double offset = a - gradient.dot(corners[0]);
    squares_[point].add_square(gradient, offset, weight);
    std::array<double, 4>& sum = sums_[point * components_ + i];
    for (int k = 0; k < 3; ++k) sum[static_cast<std::size_t>(k)] += weight * gradient[k];
    sum[3] += weight * offset;
  }
}

void ValueQuadrics::add_to(Quadric& to, std::uint32_t a, std::uint32_t b) const {
  const double weight = squares_[a].weight() + squares_[b].weight();
  if (!(weight > 0)) return;
  to.add_squares(squares_[a]);
  to.add_squares(squares_[b]);
  for (std::size_t i = 0; i < components_; ++i) {
    const std::array<double, 4>&first = sums_[a * components_ + i],
                             &second = sums_[b * components_ + i];
    const Vec3d gradient(first[0] + second[0], first[1] + second[1], first[2] + second[2]);
    to.add_square(gradient, first[3] + second[3], -1 / weight);
  }
}

void ValueQuadrics::join(std::uint32_t point, std::uint32_t other) {
  squares_[point].add(squares_[other]);
  for (std::size_t i = 0; i < components_; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      sums_[point * components_ + i][k] += sums_[other * components_ + i][k];
    }
  }
}

}  // namespace meshrepair::internal
