// openvdb_remesh ship|harp VOXELS: a model with thin parts to a volume of so many voxels across and
// back to a mesh, by OpenVDB, for comparison. Prints a line of JSON.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <string>
#include <vector>

#include <check/mesh_distance.h>

#include "../models.h"

using namespace meshrepair;

namespace {

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double extent_of(const TriangleSoup& soup) {
  Vec3d low = soup.points.front(), high = low;
  for (const Vec3d& p : soup.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).maxCoeff();
}

openvdb::FloatGrid::Ptr volume_of(const TriangleSoup& soup, double voxel) {
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

bool holds(const openvdb::FloatGrid& volume, const bench::Strand& strand) {
  const openvdb::tools::GridSampler<openvdb::FloatGrid, openvdb::tools::BoxSampler> sampler(volume);
  const std::vector<Vec3d> probes = bench::probes_of(strand);
  return std::all_of(probes.begin(), probes.end(), [&](const Vec3d& p) {
    return sampler.wsSample(openvdb::Vec3d(p.x(), p.y(), p.z())) < 0;
  });
}

TriangleSoup mesh_of(const openvdb::FloatGrid& volume) {
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

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "Usage: openvdb_remesh ship|harp VOXELS\n");
    return 2;
  }
  const bench::Model model = std::string(argv[1]) == "ship" ? bench::ship() : bench::harp();
  const double voxel = extent_of(model.soup) / std::strtod(argv[2], nullptr);
  openvdb::initialize();
  const double start = seconds();
  const openvdb::FloatGrid::Ptr volume = volume_of(model.soup, voxel);
  const TriangleSoup mesh = mesh_of(*volume);
  const double done = seconds();
  const auto held = std::count_if(model.strands.begin(), model.strands.end(),
                                  [&](const bench::Strand& s) { return holds(*volume, s); });
  const OneSidedDistance distance = one_sided_distance(mesh, model.soup);
  std::printf(
      "{\"seconds\": %.4f, \"triangles\": %zu, \"strands\": %zu, \"strands_held\": %zu, "
      "\"distance\": %.3g}\n",
      done - start, mesh.triangles.size(), model.strands.size(), static_cast<std::size_t>(held),
      distance.largest / bounding_diagonal(model.soup));
  return 0;
}
