#include "separate_copies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include <bsp/weld_points.h>

namespace meshrepair::internal {
namespace {

// Of each point: does another one have its coordinates?
std::vector<char> find_copies(const std::vector<Vec3d>& points) {
  std::vector<Vec3d> distinct;
  PointWelder welder(distinct, points.size());
  std::vector<std::uint32_t> place;
  place.reserve(points.size());
  for (const Vec3d& p : points) place.push_back(welder.index_of(p));
  std::vector<std::uint32_t> count(distinct.size(), 0);
  for (const std::uint32_t d : place) ++count[d];
  std::vector<char> copies(points.size(), 0);
  for (std::size_t p = 0; p < points.size(); ++p) copies[p] = count[place[p]] > 1 ? 1 : 0;
  return copies;
}

// The unit normal of the triangle weighted by its angle at corner k, so that how a fan is cut into
// triangles does not matter.
Vec3d weighted_normal(const TriangleSoup& mesh, const std::array<std::uint32_t, 3>& t,
                      std::size_t k) {
  const Vec3d& at = mesh.points[t[k]];
  const Vec3d a = (mesh.points[t[(k + 1) % 3]] - at).normalized();
  const Vec3d b = (mesh.points[t[(k + 2) % 3]] - at).normalized();
  const Vec3d normal = a.cross(b);
  const double sine = normal.norm();
  if (!(sine > 0)) return Vec3d::Zero();
  return std::atan2(sine, a.dot(b)) / sine * normal;
}

}  // namespace

std::size_t count_copies(const TriangleSoup& mesh) {
  const std::vector<char> copies = find_copies(mesh.points);
  return static_cast<std::size_t>(std::count(copies.begin(), copies.end(), 1));
}

std::size_t separate_copies(TriangleSoup& mesh, double distance) {
  const std::vector<char> copies = find_copies(mesh.points);
  std::vector<Vec3d> outward(mesh.points.size(), Vec3d::Zero());
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (copies[t[k]] != 0) outward[t[k]] += weighted_normal(mesh, t, k);
    }
  }
  std::size_t moved = 0;
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    const double length = outward[p].norm();
    if (copies[p] == 0 || !(length > 0)) continue;
    mesh.points[p] -= distance / length * outward[p];
    ++moved;
  }
  return moved;
}

}  // namespace meshrepair::internal
