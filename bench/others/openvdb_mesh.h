// SPDX-License-Identifier: MIT
// Between meshes and OpenVDB's level sets.
#pragma once

#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <vector>

#include <mesh/soup.h>

namespace meshrepair::bench {

inline openvdb::FloatGrid::Ptr volume_of(const TriangleSoup& soup, double voxel) {
  const auto transform = openvdb::math::Transform::createLinearTransform(voxel);
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  for (const Vec3d& p : soup.points) {
    points.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()),
                        static_cast<float>(p.z()));
  }
  for (const auto& t : soup.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  return openvdb::tools::meshToLevelSet<openvdb::FloatGrid>(*transform, points, triangles);
}

inline TriangleSoup mesh_of(const openvdb::FloatGrid& volume) {
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(volume, points, quads);
  TriangleSoup soup;
  soup.points.reserve(points.size());
  for (const auto& p : points) soup.points.emplace_back(p.x(), p.y(), p.z());
  soup.triangles.reserve(2 * quads.size());
  for (const auto& q : quads) {
    soup.triangles.push_back({q[0], q[2], q[1]});
    soup.triangles.push_back({q[0], q[3], q[2]});
  }
  return soup;
}

}  // namespace meshrepair::bench
