// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>

#include <base/error.h>
#include <base/parallel.h>
#include <base/raw_vector.h>
#include <base/shared_progress.h>
#include <check/internal/nearest_triangle.h>
#include <check/point_distances.h>
#include <mesh/mesh_parts.h>

namespace meshrepair {
namespace {

using internal::Corners;
using internal::Nearest;
using internal::NearestTriangle;

constexpr std::size_t kPointsPerLot = 2048;

RawVector<Corners> finite_triangles(const TriangleSoup& mesh) {
  RawVector<Corners> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Corners corners = {mesh.points[a], mesh.points[b], mesh.points[c]};
    if (std::all_of(corners.begin(), corners.end(), [](const Vec3d& p) { return p.allFinite(); })) {
      triangles.push_back(corners);
    }
  }
  if (triangles.empty()) throw InputError("no triangle has finite coordinates");
  return triangles;
}

// Squares of large and small lengths are beyond doubles.
UnitScale scale_of(std::span<const Vec3d> points, std::span<const Corners> triangles) {
  Vec3d largest = Vec3d::Zero();
  const auto take = [&](const Vec3d& p) { largest = largest.cwiseMax(p.cwiseAbs()); };
  std::for_each(points.begin(), points.end(), take);
  for (const Corners& corners : triangles) std::for_each(corners.begin(), corners.end(), take);
  return UnitScale(std::array{largest});
}

}  // namespace

std::vector<double> point_distances(std::span<const Vec3d> points, const TriangleSoup& mesh,
                                    ProgressObserver* progress) {
  RawVector<Corners> triangles = finite_triangles(mesh);
  const UnitScale scale = scale_of(points, triangles);
  for (Corners& corners : triangles) {
    for (Vec3d& p : corners) p = scale(p);
  }
  const NearestTriangle nearest(triangles);
  std::vector<double> distances(points.size());
  SharedProgress shared(progress, tasks_of(points.size(), kPointsPerLot));
  parallel_tasks(points.size(), kPointsPerLot,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   std::uint32_t hint = 0;
                   for (std::size_t i = first; i < last; ++i) {
                     const Nearest found = nearest.find(scale(points[i]), hint);
                     hint = found.triangle;
                     distances[i] = scale.back(std::sqrt(found.squared_distance));
                   }
                   shared.done();
                 });
  return distances;
}

}  // namespace meshrepair
