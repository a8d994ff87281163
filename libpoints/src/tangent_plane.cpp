// SPDX-License-Identifier: MIT
#include "tangent_plane.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace meshrepair {
namespace {

// Points along a line scatter less than this share to its sides, as variances: a tenth as far.
constexpr double kLineShare = 0.01;

// 1 at the point, 0 a little behind the last neighbour, smooth between.
double weight_at(double distance, double reach) {
  const double share = 1 - distance / (reach * reach);
  return share * share;
}

}  // namespace

TangentPlane fit_tangent_plane(const std::vector<Vec3d>& points, std::size_t point,
                               std::span<const std::uint32_t> neighbours) {
  TangentPlane plane;
  plane.normal = Vec3d::UnitZ();
  if (neighbours.empty()) return plane;
  const Vec3d& at = points[point];
  const double farthest = (points[neighbours.back()] - at).norm();
  const double reach = farthest > 0 ? 1.1 * farthest : 1;
  double total = 1;
  Vec3d mean = Vec3d::Zero();
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const std::uint32_t neighbour : neighbours) {
    const Vec3d offset = points[neighbour] - at;
    const double weight = weight_at(offset.squaredNorm(), reach);
    total += weight;
    mean += weight * offset;
    moments += weight * offset * offset.transpose();
  }
  mean /= total;
  // Divided by the reach, so that nothing underflows.
  moments = (moments / total - mean * mean.transpose()) / (reach * reach);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments);
  const Vec3d variance = solver.eigenvalues().cwiseMax(0);  // smallest first
  plane.normal = solver.eigenvectors().col(0).normalized();
  plane.line = variance[1] <= kLineShare * variance[2];
  const double both = variance[0] + variance[1];
  plane.roughness = both > 0 ? variance[0] / both : 0;
  return plane;
}

}  // namespace meshrepair
