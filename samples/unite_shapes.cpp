// SPDX-License-Identifier: MIT
// Unites shapes that overlap and hands the result to OpenMesh.
//
//   unite_shapes OUT IN...
//
// One idea: a soup need not be one shape. Put the triangles of several closed ones together, and
// the repair makes one solid of them; as its surface is 2-manifold, OpenMesh takes it as it is.
#include <cstdint>
#include <cstdio>
#include <exception>

#include <mesh/openmesh.h>
#include <mesh/soup_io.h>
#include <repair/repair.h>

namespace {

using namespace meshrepair;

void append(TriangleSoup& soup, const TriangleSoup& more) {
  const auto shift = static_cast<std::uint32_t>(soup.points.size());
  soup.points.insert(soup.points.end(), more.points.begin(), more.points.end());
  for (const auto& t : more.triangles) {
    soup.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fputs("usage: unite_shapes OUT IN...\n", stderr);
    return 2;
  }
  try {
    TriangleSoup shapes;
    for (int i = 2; i < argc; ++i) append(shapes, read_soup(argv[i]).soup);
    RepairOptions options;
    options.inside.rule = InsideRule::winding;  // the shapes are closed and face outward
    const RepairResult result = repair(shapes, options);

    const TriMesh mesh = to_openmesh(result.surface.mesh);
    std::size_t edges_at_points = 0;
    for (const auto vertex : mesh.vertices()) edges_at_points += vertex.valence();
    std::printf("volume %g, %zu points with %.1f edges each\n", result.report.output_volume,
                mesh.n_vertices(),
                static_cast<double>(edges_at_points) / static_cast<double>(mesh.n_vertices()));
    write_soup(from_openmesh(mesh), argv[1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "unite_shapes: %s\n", error.what());
    return 1;
  }
}
