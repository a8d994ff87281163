// SPDX-License-Identifier: MIT
// Meshes of the C interface: points and triangles.
#include <algorithm>
#include <limits>
#include <map>

#include <spdlog/fmt/fmt.h>

#include <base/error.h>
#include <mesh/mesh_limits.h>

#include "calls/attribute_keys.h"
#include "handles.h"

namespace meshrepair {
namespace {

constexpr std::size_t kMostVertices = std::numeric_limits<std::int32_t>::max();

void check_index(std::uint32_t index, std::size_t triangle, std::size_t points) {
  if (index < points) return;
  throw UsageError(fmt::format("triangle {} has the index {}, but there are {} vertices", triangle,
                               index, points));
}

TriangleSoup soup_of(const double* vertices, std::size_t vertex_count,
                     const std::uint32_t* triangles, std::size_t triangle_count) {
  if ((vertices == nullptr && vertex_count > 0) || (triangles == nullptr && triangle_count > 0)) {
    throw UsageError("there are to be vertices or triangles where NULL was given");
  }
  if (vertex_count > kMostVertices) {
    throw UsageError(fmt::format("more than {} vertices", kMostVertices));
  }
  require_triangles(triangle_count);
  TriangleSoup soup;
  soup.points.resize(vertex_count);
  for (std::size_t i = 0; i < vertex_count; ++i) {
    soup.points[i] = Vec3d(vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]);
  }
  soup.triangles.resize(triangle_count);
  for (std::size_t t = 0; t < triangle_count; ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      check_index(triangles[3 * t + k], t, vertex_count);
      soup.triangles[t][k] = triangles[3 * t + k];
    }
  }
  return soup;
}

// Points of a mesh, or of a file of points.
const std::vector<Vec3d>* points_of(const meshrepair_mesh* mesh) {
  if (mesh == nullptr) return nullptr;
  return mesh->it.cloud ? &mesh->it.cloud->points : &mesh->it.soup.points;
}

}  // namespace
}  // namespace meshrepair

void meshrepair_mesh::name_attributes() {
  attribute_names.clear();
  std::map<meshrepair::CornerAttribute::Kind, std::size_t> count;
  for (const meshrepair::CornerAttribute& attribute : it.attributes.corners) {
    attribute_names.push_back(meshrepair::attribute_key(attribute, count[attribute.kind]++));
  }
}

using namespace meshrepair;

meshrepair_mesh* meshrepair_mesh_new(const double* vertices, size_t vertex_count,
                                     const uint32_t* triangles, size_t triangle_count) {
  std::unique_ptr<meshrepair_mesh> mesh;
  (void)guarded([&] {
    auto made = std::make_unique<meshrepair_mesh>();
    made->it.soup = soup_of(vertices, vertex_count, triangles, triangle_count);
    mesh = std::move(made);
  });
  return mesh.release();
}

void meshrepair_mesh_free(meshrepair_mesh* mesh) { delete mesh; }

size_t meshrepair_mesh_vertex_count(const meshrepair_mesh* mesh) {
  return mesh == nullptr ? 0 : points_of(mesh)->size();
}

size_t meshrepair_mesh_triangle_count(const meshrepair_mesh* mesh) {
  return mesh == nullptr ? 0 : mesh->it.soup.triangles.size();
}

const double* meshrepair_mesh_vertices(const meshrepair_mesh* mesh) {
  static_assert(sizeof(Vec3d) == 3 * sizeof(double));
  if (mesh == nullptr || points_of(mesh)->empty()) return nullptr;
  return points_of(mesh)->front().data();
}

const uint32_t* meshrepair_mesh_triangles(const meshrepair_mesh* mesh) {
  static_assert(sizeof(TriangleSoup::triangles[0]) == 3 * sizeof(std::uint32_t));
  if (mesh == nullptr || mesh->it.soup.triangles.empty()) return nullptr;
  return mesh->it.soup.triangles.front().data();
}
