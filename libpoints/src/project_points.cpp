// SPDX-License-Identifier: MIT
#include "project_points.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "point_blocks.h"
#include "point_index.h"
#include "tangent_plane.h"

namespace meshrepair {
namespace {

// A quadratic surface has six numbers: twice the points that a plane is fitted to even out their
// noise.
constexpr std::size_t kFactor = 2;

// The quadratic terms are held towards 0, as much as this share of the points would: a plane where
// the points do not tell.
constexpr double kRidge = 1e-3;

using Numbers = Eigen::Matrix<double, 6, 1>;
using Moments = Eigen::Matrix<double, 6, 6>;

// The height at the point of the surface through its neighbours, over the plane through the point.
double height_at(const std::vector<Vec3d>& points, std::size_t point,
                 std::span<const std::uint32_t> around, const Vec3d& normal) {
  const Vec3d& at = points[point];
  const Vec3d axis_x = normal.unitOrthogonal();
  const Vec3d axis_y = normal.cross(axis_x);
  const double reach = 1.1 * (points[around.back()] - at).norm();
  if (!(reach > 0)) return 0;
  Moments moments = Moments::Zero();
  Numbers right = Numbers::Zero();
  double total = 1;
  moments(0, 0) = 1;  // the point itself
  for (const std::uint32_t neighbour : around) {
    const Vec3d offset = (points[neighbour] - at) / reach;
    const double x = offset.dot(axis_x);
    const double y = offset.dot(axis_y);
    const double share = std::max(0.0, 1 - offset.squaredNorm());
    const double weight = share * share;
    const Numbers row = {1, x, y, x * x, x * y, y * y};
    moments += weight * row * row.transpose();
    right += weight * offset.dot(normal) * row;
    total += weight;
  }
  for (int i = 3; i < 6; ++i) moments(i, i) += kRidge * total;
  const Numbers fit = moments.ldlt().solve(right);
  return std::isfinite(fit[0]) ? reach * fit[0] : 0;
}

// Points nearer to each other than this share of the spacing tell more of what noise is left than
// of the surface.
constexpr double kTooNear = 0.4;

// Of points that are too near, the first stays.
void thin_out(SiftedCloud& cloud) {
  const PointIndex index(cloud.points);
  std::vector<char> dropped(cloud.points.size(), 0);
  std::vector<Neighbour> found(16);
  std::size_t kept = 0;
  for (std::uint32_t p = 0; p < cloud.points.size(); ++p) {
    const double least = kTooNear * cloud.spacing[p];
    const std::size_t count = index.nearest(cloud.points[p], found);
    for (std::size_t i = 0; i < count && found[i].distance < least * least; ++i) {
      if (found[i].point < p && dropped[found[i].point] == 0) dropped[p] = 1;
    }
    kept += dropped[p] == 0;
  }
  std::size_t to = 0;
  for (std::size_t p = 0; p < dropped.size(); ++p) {
    if (dropped[p] != 0) continue;
    cloud.points[to] = cloud.points[p];
    cloud.original[to] = cloud.original[p];
    if (!cloud.normals.empty()) cloud.normals[to] = cloud.normals[p];
    ++to;
  }
  cloud.points.resize(kept);
  cloud.original.resize(kept);
  if (!cloud.normals.empty()) cloud.normals.resize(kept);
}

}  // namespace

double project_points(SiftedCloud& cloud, const PointSoupOptions& options) {
  const std::vector<Vec3d> before = cloud.points;
  CancelOnly cancel(options.progress);
  for (int i = 0; i < options.project; ++i) {
    const PointIndex index(cloud.points);
    const Neighbourhoods around =
        find_neighbourhoods(index, cloud.points, kFactor * options.neighbours, &cancel);
    std::vector<Vec3d> moved = cloud.points;
    for_blocks(moved.size(), &cancel, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t p = first; p < last; ++p) {
        const TangentPlane plane = fit_tangent_plane(cloud.points, p, around.of(p));
        const double height = height_at(cloud.points, p, around.of(p), plane.normal);
        // Farther away there is no telling what the neighbours are neighbours of.
        const double farthest = cloud.spacing[p];
        moved[p] += std::clamp(height, -farthest, farthest) * plane.normal;
      }
    });
    cloud.points = std::move(moved);
  }
  double farthest = 0;
  for (std::size_t p = 0; p < before.size(); ++p) {
    farthest = std::max(farthest, (cloud.points[p] - before[p]).norm());
  }
  thin_out(cloud);
  return farthest;
}

}  // namespace meshrepair
