// SPDX-License-Identifier: MIT
#include "wide_spaces.h"

#include <algorithm>
#include <cmath>

#include <base/parallel.h>
#include <check/internal/nearest_triangle.h>
#include <check/soup_rays.h>
#include <mesh/mesh_parts.h>

namespace meshrepair::internal {
namespace {

constexpr double kLargestBall = 1.0 / 8;  // its diameter, as a share of the mesh's diagonal

// Between two places whose balls overlap nothing is in the way.
constexpr double kOverlap = 0.5;  // of their distance

// 1 for the triangles of parts that face inward.
std::vector<std::int32_t> walls_of_voids(const TriangleSoup& mesh) {
  const MeshParts parts = find_parts(mesh);
  const std::vector<PartSize> sizes = part_sizes(mesh.points, mesh.triangles, parts.of_triangle,
                                                 parts.count, UnitScale(mesh.points));
  std::vector<std::int32_t> is_wall;
  is_wall.reserve(parts.of_triangle.size());
  for (const std::uint32_t part : parts.of_triangle) {
    is_wall.push_back(sizes[part].volume < 0 ? 1 : 0);
  }
  return is_wall;
}

}  // namespace

WideSpaces::WideSpaces(const TriangleSoup& mesh, ProgressObserver* progress) {
  lay_out(mesh);
  measure(mesh);
  leave_empty_spaces(mesh, progress);
}

bool WideSpaces::lie_behind(double diameter) const {
  std::vector<char> reached(clearance_.size(), 0);
  flood(0, std::max(diameter / 2, kOverlap * step_), reached);
  const double room = std::max(diameter, step_);
  for (std::size_t p = 0; p < reached.size(); ++p) {
    if (reached[p] == 0 && clearance_[p] >= room) return true;
  }
  return false;
}

// The first place and all others at the border are outside, where the largest ball rolls around the
// mesh.
void WideSpaces::lay_out(const TriangleSoup& mesh) {
  Vec3d high = mesh.points.front();
  low_ = high;
  for (const Vec3d& p : mesh.points) {
    low_ = low_.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  step_ = (high - low_).maxCoeff() / kSide;
  const double margin = 1 + std::ceil(kLargestBall / 2 * (high - low_).norm() / step_);
  low_.array() -= margin * step_;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    size_[k] = static_cast<std::size_t>(std::ceil((high[i] - low_[i]) / step_ + margin)) + 1;
  }
}

void WideSpaces::measure(const TriangleSoup& mesh) {
  std::vector<Corners> corners;
  corners.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    corners.push_back({mesh.points[a], mesh.points[b], mesh.points[c]});
  }
  const NearestTriangle nearest(corners);
  clearance_.resize(size_[0] * size_[1] * size_[2]);
  const std::size_t row = size_[0];
  parallel_for(size_[1] * size_[2], [&](std::size_t r) {
    std::uint32_t hint = 0;
    for (std::size_t p = r * row; p < (r + 1) * row; ++p) {
      const Nearest found = nearest.find(at(p), hint);
      hint = found.triangle;
      clearance_[p] = static_cast<float>(std::sqrt(found.squared_distance));
    }
  });
}

// One place tells for all that a way leads to.
void WideSpaces::leave_empty_spaces(const TriangleSoup& mesh, ProgressObserver* progress) {
  const std::vector<std::int32_t> once(mesh.triangles.size(), 1), walls = walls_of_voids(mesh);
  const SoupRays solids(mesh, once), voids(mesh, walls);
  CancelCheck check(progress);
  std::vector<char> seen(clearance_.size(), 0);
  flood(0, kOverlap * step_, seen);
  for (std::size_t p = 0; p < seen.size(); ++p) {
    if (seen[p] != 0 || clearance_[p] < step_) continue;
    check.ask();
    const std::vector<std::size_t> space = flood(p, kOverlap * step_, seen);
    const Vec3d point = at(p);
    if (solids.winding_at(point) == 0 && voids.winding_at(point) == 0) continue;
    for (const std::size_t q : space) clearance_[q] = 0;
  }
}

Vec3d WideSpaces::at(std::size_t place) const {
  const std::size_t x = place % size_[0], y = place / size_[0] % size_[1],
                    z = place / (size_[0] * size_[1]);
  return low_ +
         step_ * Vec3d(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
}

std::vector<std::size_t> WideSpaces::flood(std::size_t from, double clearance,
                                           std::vector<char>& reached) const {
  const std::array<std::size_t, 3> strides = {1, size_[0], size_[0] * size_[1]};
  std::vector<std::size_t> all = {from};
  reached[from] = 1;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::size_t p = all[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t along = p / strides[k] % size_[k];
      const auto enter = [&](std::size_t q) {
        if (reached[q] != 0 || clearance_[q] < clearance) return;
        reached[q] = 1;
        all.push_back(q);
      };
      if (along > 0) enter(p - strides[k]);
      if (along + 1 < size_[k]) enter(p + strides[k]);
    }
  }
  return all;
}

}  // namespace meshrepair::internal
