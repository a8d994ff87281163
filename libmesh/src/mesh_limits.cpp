// SPDX-License-Identifier: MIT
#include <base/error.h>
#include <mesh/mesh_limits.h>

namespace meshrepair {
namespace {

void require_at_most(std::size_t most, std::uint64_t count, const std::string& name,
                     const std::string& what) {
  if (count <= most) return;
  throw LimitError((name.empty() ? name : name + ": ") + "more than " + std::to_string(most) + " " +
                   what);
}

}  // namespace

void require_points(std::uint64_t points, const std::string& name) {
  require_at_most(kMostPoints, points, name, "points");
}

void require_triangles(std::uint64_t triangles, const std::string& name) {
  require_at_most(kMostTriangles, triangles, name, "triangles");
}

}  // namespace meshrepair
