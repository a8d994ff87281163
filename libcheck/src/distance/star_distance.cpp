// SPDX-License-Identifier: MIT
// Both stars have the link as their border, and cover what is inside the border once, seen along
// the normal. So each point of the new star has one of the old star above or below it, and where
// edges of neither pass between, the distance along the normal changes linearly. What is left to
// look at are the places where an edge of one lies over an edge or the centre of the other.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Geometry>

#include <check/internal/star_distance.h>

namespace meshrepair::internal {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Of products of coordinates up to 1. What is nearer to an edge counts as on it, which looks at a
// place too many, not at one too few.
constexpr double kRounding = 0x1p-50;

double cross(const StarPoint& a, const StarPoint& b) { return a.x * b.y - a.y * b.x; }

double turn(const StarPoint& a, const StarPoint& b, const StarPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// From the centre to the triangle along the normal; nothing where it lies beside the centre.
std::optional<double> distance_from_centre(const StarPoint& a, const StarPoint& b,
                                           const StarPoint& c) {
  const double of_a = cross(b, c), of_b = cross(c, a), of_c = cross(a, b);
  if (std::min({of_a, of_b, of_c}) < -kRounding) return std::nullopt;
  return std::abs((of_a * a.z + of_b * b.z + of_c * c.z) / turn(a, b, c));
}

// Between two segments along the normal, 0 where they do not cross.
double distance_between(const StarPoint& a, const StarPoint& b, const StarPoint& c,
                        const StarPoint& d) {
  const double of_a = turn(c, d, a), of_b = turn(c, d, b);
  const double of_c = turn(a, b, c), of_d = turn(a, b, d);
  const double across = of_a - of_b, along = of_c - of_d;
  if (std::min(std::abs(across), std::abs(along)) < kRounding) return 0;  // parallel: points tell
  const double on_first = of_a / across, on_second = of_c / along;
  const double most = 1 + kRounding;
  if (std::min(on_first, on_second) < -kRounding || std::max(on_first, on_second) > most) return 0;
  return std::abs(a.z + on_first * (b.z - a.z) - (c.z + on_second * (d.z - c.z)));
}

}  // namespace

void StarDistance::set_star(const Vec3d& centre, std::span<const Vec3d> link) {
  double size = 0;
  for (const Vec3d& p : link) size = std::max(size, (p - centre).cwiseAbs().maxCoeff());
  int exponent = 0;
  std::frexp(size, &exponent);
  unit_ = std::ldexp(1.0, exponent);
  Vec3d normal = Vec3d::Zero();
  for (std::size_t i = 0; i < link.size(); ++i) {
    const Vec3d& next = link[i + 1 == link.size() ? 0 : i + 1];
    normal += ((link[i] - centre) / unit_).cross((next - centre) / unit_);
  }
  link_.clear();
  const double length = normal.norm();
  is_flat_fan_ = false;
  if (!(length > kRounding)) return;
  normal /= length;
  const Vec3d across = normal.unitOrthogonal(), up = normal.cross(across);
  for (const Vec3d& p : link) {
    const Vec3d d = (p - centre) / unit_;
    link_.push_back({d.dot(across), d.dot(up), d.dot(normal)});
  }
  is_flat_fan_ = is_flat_fan();
}

// Whether all triangles lie beside each other, once round the centre: the link is a simple polygon.
bool StarDistance::is_flat_fan() const {
  std::size_t turns = 0;
  for (std::size_t i = 0; i < link_.size(); ++i) {
    const StarPoint &a = link_[i], &b = link_[after(i)];
    if (!(cross(a, b) > kRounding)) return false;
    turns += a.y < 0 && b.y >= 0 ? 1 : 0;
  }
  return turns == 1;
}

double StarDistance::bound(std::size_t to, double most) const {
  if (!is_flat_fan_) return kInfinite;
  constexpr StarPoint kCentre{0, 0, 0};
  const StarPoint& target = link_[to];
  most /= unit_;
  double worst = 0;
  bool covered = false;
  for (std::size_t i = after(to); after(i) != to; i = after(i)) {
    const StarPoint &a = link_[i], &b = link_[after(i)];
    if (!(turn(target, a, b) > kRounding)) return kInfinite;
    if (const auto distance = distance_from_centre(target, a, b)) {
      covered = true;
      worst = std::max(worst, *distance);
    }
    if (worst > most) return kInfinite;
  }
  if (!covered) return kInfinite;
  for (std::size_t i = after(after(to)); after(i) != to; i = after(i)) {
    for (std::size_t k = 0; k < link_.size(); ++k) {
      if (k == i || k == to) continue;
      worst = std::max(worst, distance_between(kCentre, link_[k], target, link_[i]));
    }
    if (worst > most) return kInfinite;
  }
  return worst * unit_;
}

}  // namespace meshrepair::internal
