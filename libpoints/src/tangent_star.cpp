#include "tangent_star.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace meshrepair {

void TangentStar::begin(const Vec3d& at, const Vec3d& normal, double limit) {
  at_ = at;
  axis_x_ = normal.unitOrthogonal();
  axis_y_ = normal.cross(axis_x_);
  corners_.assign({{-limit, -limit, kNone},
                   {limit, -limit, kNone},
                   {limit, limit, kNone},
                   {-limit, limit, kNone}});
}

void TangentStar::add(std::uint32_t neighbour, const Vec3d& position, double excess) {
  // The bisector, cut with the plane: 2 d.x = |q - p|^2 + w_p - w_q, where d is q - p in the plane.
  const Vec3d offset = position - at_;
  const double dx = offset.dot(axis_x_);
  const double dy = offset.dot(axis_y_);
  const double reach = 0.5 * (offset.squaredNorm() - excess);
  side_.clear();
  bool any_beyond = false;
  for (const Corner& corner : corners_) {
    side_.push_back(dx * corner.x + dy * corner.y - reach);
    any_beyond |= side_.back() > 0;
  }
  if (!any_beyond) return;
  clipped_.clear();
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const std::size_t next = i + 1 < corners_.size() ? i + 1 : 0;
    const Corner& here = corners_[i];
    const bool inside = side_[i] <= 0;
    if (inside) clipped_.push_back(here);
    if (inside == (side_[next] <= 0)) continue;
    // The new corner begins the bisector's side where the polygon is left, and what is left of the
    // old side where it is entered again.
    const double share = side_[i] / (side_[i] - side_[next]);
    clipped_.push_back({here.x + share * (corners_[next].x - here.x),
                        here.y + share * (corners_[next].y - here.y),
                        inside ? neighbour : here.neighbour});
  }
  corners_.swap(clipped_);
}

double TangentStar::squared_radius() const {
  double largest = 0;
  for (const Corner& corner : corners_) largest = std::max(largest, corner.squared_radius());
  return largest;
}

}  // namespace meshrepair
