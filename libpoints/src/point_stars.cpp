// SPDX-License-Identifier: MIT
#include "point_stars.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include <base/release.h>

#include "point_blocks.h"
#include "point_index.h"

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

namespace {

// A star that the usual neighbours do not close, at a rim or beside a hole, asks for twice as many,
// and again, up to so many.
constexpr std::size_t kMostNeighbours = 160;

// Where points lie along a line, as in scans, so many times the neighbours are looked at.
constexpr std::size_t kLineFactor = 4;

// Weights are up to this share of the squared spacing: far above the rounding of coordinates, far
// below what moves a bisector to be seen.
constexpr double kWeightShare = 1e-3;

// Triangles steeper than this against the plane of the point that wants them are no part of a
// surface there: the cosine of 80 degrees.
constexpr double kSteepest = 0.17;

// A number in [0, 1) that looks like chance but is the same for a point in every star.
double chance_of(std::uint32_t point) {
  std::uint64_t bits = point + 0x9E3779B97F4A7C15ull;
  bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9ull;
  bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBull;
  bits ^= bits >> 31;
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

class StarBuilder {
 public:
  StarBuilder(const SiftedCloud& cloud, const std::vector<TangentPlane>& planes,
              const PointSoupOptions& options)
      : cloud_(cloud), planes_(planes), options_(options) {}

  void build(std::uint32_t point, std::vector<StarTriangle>& out) {
    const Vec3d& at = cloud_.points[point];
    limit_ = options_.reach * cloud_.spacing[point];
    star_.begin(at, planes_[point].normal, limit_);
    for (const std::uint32_t neighbour : cloud_.around.of(point)) {
      if (is_closed(distance(point, neighbour))) return emit(point, out);
      add(point, neighbour);
    }
    // A point itself is among its nearest ones.
    std::size_t known = cloud_.around.per_point + 1;
    for (std::size_t count = 2 * known; known < kMostNeighbours; count *= 2) {
      more_.resize(std::min(count, kMostNeighbours));
      const std::size_t found = cloud_.index->nearest(at, more_);
      for (std::size_t i = known - 1; i < found; ++i) {
        if (is_closed(more_[i].distance)) return emit(point, out);
        if (more_[i].point != point) add(point, more_[i].point);
      }
      if (found < more_.size()) break;
      known = found;
    }
    emit(point, out);
  }

 private:
  [[nodiscard]] double distance(std::uint32_t a, std::uint32_t b) const {
    return (cloud_.points[a] - cloud_.points[b]).squaredNorm();
  }

  [[nodiscard]] double weight(std::uint32_t point) const {
    return kWeightShare * cloud_.spacing[point] * cloud_.spacing[point] * chance_of(point);
  }

  // Whether no point from this squared distance on makes a difference: its bisector is at least
  // half as far away, but for weights.
  [[nodiscard]] bool is_closed(double squared_distance) const {
    constexpr double kForWeights = 1.01;
    const double radius = std::min(star_.squared_radius(), limit_ * limit_);
    return squared_distance > 4 * kForWeights * radius;
  }

  void add(std::uint32_t point, std::uint32_t neighbour) {
    star_.add(neighbour, cloud_.points[neighbour], weight(neighbour) - weight(point));
  }

  void emit(std::uint32_t point, std::vector<StarTriangle>& out) const {
    const auto& corners = star_.corners();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::uint32_t before = corners[i == 0 ? corners.size() - 1 : i - 1].neighbour;
      const std::uint32_t after = corners[i].neighbour;
      if (before == TangentStar::kNone || after == TangentStar::kNone || before == after) continue;
      if (corners[i].squared_radius() > limit_ * limit_) continue;
      if (is_too_steep(point, before, after)) continue;
      out.push_back(sorted({point, before, after}, knows_outside(point)));
    }
  }

  [[nodiscard]] bool is_too_steep(std::uint32_t point, std::uint32_t a, std::uint32_t b) const {
    const Vec3d& at = cloud_.points[point];
    const Vec3d normal = (cloud_.points[a] - at).cross(cloud_.points[b] - at);
    return std::abs(normal.dot(planes_[point].normal)) < kSteepest * normal.norm();
  }

  [[nodiscard]] bool knows_outside(std::uint32_t point) const {
    return !cloud_.normals.empty() && cloud_.normals[point] != Vec3d::Zero();
  }

  // `corners` are counter-clockwise around the normal.
  static StarTriangle sorted(std::array<std::uint32_t, 3> corners, bool knows_outside) {
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    StarTriangle triangle = {corners, static_cast<std::int8_t>(knows_outside ? 1 : 0)};
    if (corners[1] > corners[2]) {
      std::swap(triangle.corners[1], triangle.corners[2]);
      triangle.turn = static_cast<std::int8_t>(-triangle.turn);
    }
    return triangle;
  }

  const SiftedCloud& cloud_;
  const std::vector<TangentPlane>& planes_;
  const PointSoupOptions& options_;
  double limit_ = 0;
  TangentStar star_;
  std::vector<Neighbour> more_;
};

// The plane of a point that lies on a line of others: farther ones tell more.
TangentPlane fit_farther(const SiftedCloud& cloud, std::size_t point, std::vector<Neighbour>& found,
                         std::vector<std::uint32_t>& others) {
  const std::size_t count = cloud.index->nearest(cloud.points[point], found);
  others.clear();
  for (std::size_t i = 0; i < count; ++i) {
    if (found[i].point != point) others.push_back(found[i].point);
  }
  return fit_tangent_plane(cloud.points, point, others);
}

}  // namespace

std::vector<TangentPlane> find_tangent_planes(const SiftedCloud& cloud,
                                              const PointSoupOptions& options) {
  std::vector<TangentPlane> planes(cloud.points.size());
  CancelOnly cancel(options.progress);
  for_blocks(planes.size(), &cancel, [&](std::size_t, std::size_t first, std::size_t last) {
    std::vector<Neighbour> found(kLineFactor * options.neighbours + 1);
    std::vector<std::uint32_t> others;
    for (std::size_t p = first; p < last; ++p) {
      if (!cloud.normals.empty() && cloud.normals[p] != Vec3d::Zero()) {
        planes[p].normal = cloud.normals[p];
        continue;
      }
      const auto around = cloud.around.of(p);
      planes[p] = fit_tangent_plane(cloud.points, p,
                                    around.first(std::min(options.neighbours, around.size())));
      if (planes[p].line) planes[p] = fit_farther(cloud, p, found, others);
    }
  });
  return planes;
}

std::vector<StarTriangle> build_stars(const SiftedCloud& cloud,
                                      const std::vector<TangentPlane>& planes,
                                      const PointSoupOptions& options) {
  std::vector<std::vector<StarTriangle>> blocks(blocks_of(cloud.points.size()));
  for_blocks(cloud.points.size(), options.progress,
             [&](std::size_t block, std::size_t first, std::size_t last) {
               StarBuilder builder(cloud, planes, options);
               blocks[block].reserve(7 * (last - first));  // six on average
               for (std::size_t i = first; i < last; ++i) {
                 builder.build(cloud.index->order()[i], blocks[block]);
               }
             });
  std::vector<StarTriangle> all;
  std::size_t count = 0;
  for (const auto& block : blocks) count += block.size();
  all.reserve(count);
  for (auto& block : blocks) {
    all.insert(all.end(), block.begin(), block.end());
    release(block);
  }
  return all;
}

}  // namespace meshrepair
