#include "flat_sheets.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <mesh/precision.h>
#include <mesh/topology.h>
#include <repair/orient_parts.h>

#include "open_sheets.h"

namespace meshrepair::internal {
namespace {

// Three points tell the plane, each of which may be off: another one may seem so much farther off.
constexpr double kSeenOff = 4;

const Vec3d& farthest(const std::vector<Vec3d>& points, const auto& distance) {
  return *std::max_element(points.begin(), points.end(), [&](const Vec3d& a, const Vec3d& b) {
    return distance(a) < distance(b);
  });
}

const Vec3d& farthest_from(const Vec3d& p, const std::vector<Vec3d>& points) {
  return farthest(points, [&](const Vec3d& q) { return (q - p).squaredNorm(); });
}

}  // namespace

double rounding_of(const CleanSoup& soup) {
  bool is_single = true;
  double most = 0;
  for (const Vec3d& p : soup.points) {
    is_single = is_single && rounded_to(p, Precision::float32) == p;
    most = std::max(most, p.cwiseAbs().maxCoeff());
  }
  const double spacing = is_single ? number_spacing(most, Precision::float32) / soup.grid.unit : 0;
  return 0.5 * std::numbers::sqrt3 * std::max(1.0, spacing);
}

Vec3d original_place(const CleanSoup& soup, PointId point) {
  return (soup.points[point] - soup.grid.origin) / soup.grid.unit;
}

bool is_flat(const std::vector<Vec3d>& points, double rounding) {
  const Vec3d& first = farthest_from(points.front(), points);
  const Vec3d along = (farthest_from(first, points) - first).normalized();
  const Vec3d& beside =
      farthest(points, [&](const Vec3d& p) { return (p - first).cross(along).squaredNorm(); });
  const Vec3d normal = along.cross(beside - first).normalized();
  return std::all_of(points.begin(), points.end(), [&](const Vec3d& p) {
    return std::abs((p - first).dot(normal)) <= kSeenOff * rounding;
  });
}

bool is_flat_sheet(const CleanSoup& soup) {
  std::vector<Vec3d> corners;
  for (const Triangle& t : soup.triangles) {
    if (t.source == Triangle::kNoSource) break;
    for (const PointId p : t.corners) corners.push_back(original_place(soup, p));
  }
  if (!is_flat(corners, rounding_of(soup))) return false;
  std::vector<IndexTriangle> triangles = index_triangles(soup);
  triangles.resize(corners.size() / 3);
  const std::vector<char> open = triangles_of_open_parts(triangles, soup.points.size());
  return std::all_of(open.begin(), open.end(), [](char x) { return x != 0; });
}

std::vector<char> triangles_of_flat_parts(const CleanSoup& soup) {
  TopologyPlaces places;
  const std::size_t parts =
      examine_topology(index_triangles(soup), soup.points.size(), &places).parts;
  std::vector<std::vector<Vec3d>> corners(parts);
  for (std::size_t t = 0; t < places.parts.size(); ++t) {
    for (const PointId p : soup.triangles[TriangleId(t)].corners) {
      corners[places.parts[t]].push_back(original_place(soup, p));
    }
  }
  const double rounding = rounding_of(soup);
  std::vector<char> flat;
  flat.reserve(parts);
  for (const std::vector<Vec3d>& part : corners) flat.push_back(is_flat(part, rounding) ? 1 : 0);
  std::vector<char> of_triangles;
  of_triangles.reserve(places.parts.size());
  for (const std::uint32_t part : places.parts) of_triangles.push_back(flat[part]);
  return of_triangles;
}

}  // namespace meshrepair::internal
