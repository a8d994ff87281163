// SPDX-License-Identifier: MIT
// openvdb_remesh ship|harp VOXELS: a model with thin parts to a volume of so many voxels across and
// back to a mesh, by OpenVDB, for comparison. Prints a line of JSON.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#include <string>
#include <vector>

#include <check/mesh_distance.h>

#include "../models.h"
#include "openvdb_mesh.h"

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

bool holds(const openvdb::FloatGrid& volume, const bench::Strand& strand) {
  const openvdb::tools::GridSampler<openvdb::FloatGrid, openvdb::tools::BoxSampler> sampler(volume);
  const std::vector<Vec3d> probes = bench::probes_of(strand);
  return std::all_of(probes.begin(), probes.end(), [&](const Vec3d& p) {
    return sampler.wsSample(openvdb::Vec3d(p.x(), p.y(), p.z())) < 0;
  });
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
  const openvdb::FloatGrid::Ptr volume = bench::volume_of(model.soup, voxel);
  const TriangleSoup mesh = bench::mesh_of(*volume);
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
