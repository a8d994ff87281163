#include <algorithm>
#include <cmath>

#include <base/error.h>
#include <base/parallel.h>
#include <base/raw_vector.h>
#include <base/shared_progress.h>
#include <check/nearest_triangle.h>
#include <check/point_distances.h>

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

}  // namespace

std::vector<double> point_distances(std::span<const Vec3d> points, const TriangleSoup& mesh,
                                    ProgressObserver* progress) {
  const NearestTriangle nearest(finite_triangles(mesh));
  std::vector<double> distances(points.size());
  SharedProgress shared(progress, tasks_of(points.size(), kPointsPerLot));
  parallel_tasks(points.size(), kPointsPerLot,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   std::uint32_t hint = 0;
                   for (std::size_t i = first; i < last; ++i) {
                     const Nearest found = nearest.find(points[i], hint);
                     hint = found.triangle;
                     distances[i] = std::sqrt(found.squared_distance);
                   }
                   shared.done();
                 });
  return distances;
}

}  // namespace meshrepair
