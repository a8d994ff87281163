#include "part_volumes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include <bsp/topology.h>

namespace meshrepair::internal {
namespace {

constexpr double kMostChange = 0.1;

}  // namespace

PartVolumes::PartVolumes(const TriangleSoup& mesh) {
  TopologyPlaces places;
  origins_.reserve(examine_topology(mesh.triangles, mesh.points.size(), &places).parts);
  part_of_ = std::move(places.parts);
  double size = 0;
  for (std::size_t t = 0; t < part_of_.size(); ++t) {
    const Vec3d& p = mesh.points[mesh.triangles[t][0]];
    if (part_of_[t] == origins_.size()) origins_.push_back(p);
    size = std::max(size, (p - origins_[0]).cwiseAbs().maxCoeff());
  }
  if (size > 0) unit_ = std::ldexp(1.0, std::ilogb(size));
  before_ = volumes(mesh, part_of_);
}

// Six times, in cubes of the unit.
std::vector<double> PartVolumes::volumes(const TriangleSoup& mesh,
                                         const std::vector<std::uint32_t>& part_of) const {
  std::vector<double> sums(origins_.size(), 0);
  for (std::size_t t = 0; t < part_of.size(); ++t) {
    const Vec3d& origin = origins_[part_of[t]];
    const auto& corners = mesh.triangles[t];
    const Vec3d a = (mesh.points[corners[0]] - origin) / unit_;
    const Vec3d b = (mesh.points[corners[1]] - origin) / unit_;
    const Vec3d c = (mesh.points[corners[2]] - origin) / unit_;
    sums[part_of[t]] += a.dot(b.cross(c));
  }
  return sums;
}

std::vector<char> PartVolumes::in_thin_parts(const TriangleSoup& mesh, double thickness) const {
  std::vector<double> areas(origins_.size(), 0);
  for (std::size_t t = 0; t < part_of_.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    const Vec3d u = (mesh.points[corners[1]] - mesh.points[corners[0]]) / unit_;
    const Vec3d v = (mesh.points[corners[2]] - mesh.points[corners[0]]) / unit_;
    areas[part_of_[t]] += u.cross(v).norm() / 2;
  }
  std::vector<char> thin;
  thin.reserve(part_of_.size());
  for (const std::uint32_t part : part_of_) {
    thin.push_back(std::abs(before_[part]) < areas[part] * (thickness / unit_) ? 1 : 0);
  }
  return thin;
}

std::vector<std::uint32_t> PartVolumes::altered(const TriangleSoup& mesh,
                                                const std::vector<std::uint32_t>& was,
                                                const std::vector<std::uint32_t>& changed) const {
  std::vector<std::uint32_t> part_of;
  part_of.reserve(was.size());
  for (const std::uint32_t t : was) part_of.push_back(part_of_[t]);
  const std::vector<double> after = volumes(mesh, part_of);
  std::vector<std::uint32_t> result;
  for (const std::uint32_t t : changed) {
    const double volume = before_[part_of[t]];
    const bool same = std::abs(after[part_of[t]] - volume) <= kMostChange * std::abs(volume);
    if (!same) result.push_back(t);
  }
  return result;
}

}  // namespace meshrepair::internal
