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

// Points by where they lie.
struct Places {
  std::vector<std::uint32_t> place;  // of each point; points with equal coordinates have the same
  std::vector<char> is_copy;         // of each point: has another one its place?
};

Places find_places(const std::vector<Vec3d>& points) {
  std::vector<Vec3d> distinct;
  PointWelder welder(distinct, points.size());
  Places places;
  places.place.reserve(points.size());
  for (const Vec3d& p : points) places.place.push_back(welder.index_of(p));
  std::vector<std::uint32_t> count(distinct.size(), 0);
  for (const std::uint32_t d : places.place) ++count[d];
  for (const std::uint32_t d : places.place) places.is_copy.push_back(count[d] > 1 ? 1 : 0);
  return places;
}

// Of each point: does an edge of its lie where one of its copies has one?
std::vector<char> find_common_edges(const TriangleSoup& mesh, const Places& places) {
  // From a place to a place, and the point that the edge starts at.
  std::vector<std::array<std::uint32_t, 3>> edges;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t p = t[k];
      if (places.is_copy[p] == 0) continue;
      for (const std::uint32_t q : {t[(k + 1) % 3], t[(k + 2) % 3]}) {
        edges.push_back({places.place[p], places.place[q], p});
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<char> common(mesh.points.size(), 0);
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const auto &a = edges[i - 1], &b = edges[i];
    if (a[0] == b[0] && a[1] == b[1] && a[2] != b[2]) common[a[2]] = common[b[2]] = 1;
  }
  return common;
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
  const Places places = find_places(mesh.points);
  return static_cast<std::size_t>(std::count(places.is_copy.begin(), places.is_copy.end(), 1));
}

std::size_t separate_copies(TriangleSoup& mesh, double distance, Touching touching) {
  const Places places = find_places(mesh.points);
  std::vector<char> goes_out(mesh.points.size(), 0);
  if (touching == Touching::join) goes_out = find_common_edges(mesh, places);
  std::vector<Vec3d> outward(mesh.points.size(), Vec3d::Zero());
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (places.is_copy[t[k]] != 0) outward[t[k]] += weighted_normal(mesh, t, k);
    }
  }
  std::size_t moved = 0;
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    const double length = outward[p].norm();
    if (places.is_copy[p] == 0 || !(length > 0)) continue;
    mesh.points[p] += (goes_out[p] != 0 ? distance : -distance) / length * outward[p];
    ++moved;
  }
  return moved;
}

}  // namespace meshrepair::internal
