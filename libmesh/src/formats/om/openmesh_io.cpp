// SPDX-License-Identifier: MIT
#include <array>
#include <numeric>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <base/error.h>
#include <mesh/openmesh.h>

namespace meshrepair {
namespace {

[[noreturn]] void refuse(std::size_t triangle, const std::string& why) {
  throw InputError("triangle " + std::to_string(triangle) + " " + why);
}

// Checks that a half-edge mesh can hold the soup, so that OpenMesh never meets what it would print
// about.
class ManifoldCheck {
 public:
  explicit ManifoldCheck(const TriangleSoup& soup) : soup_(soup), fan_(3 * soup.triangles.size()) {
    std::iota(fan_.begin(), fan_.end(), std::size_t{0});
  }

  void run() {
    for (std::size_t t = 0; t < soup_.triangles.size(); ++t) add_edges(t);
    for (const auto& [edge, corner] : corner_of_edge_) join_fans(edge, corner);
    check_fans();
  }

 private:
  using Edge = std::uint64_t;  // directed: from << 32 | to

  static Edge edge_between(std::uint32_t from, std::uint32_t to) { return Edge{from} << 32 | to; }

  void add_edges(std::size_t t) {
    const auto& corners = soup_.triangles[t];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = corners[i];
      const std::uint32_t to = corners[(i + 1) % 3];
      if (from >= soup_.points.size()) refuse(t, "names a point that does not exist");
      if (from == to) refuse(t, "has two equal corners");
      if (!corner_of_edge_.emplace(edge_between(from, to), 3 * t + i).second) {
        refuse(t, "has an edge, " + std::to_string(from) + " to " + std::to_string(to) +
                      ", that another triangle has in the same direction");
      }
    }
  }

  // The triangles on both sides of an edge belong to the same fan at both ends of it.
  void join_fans(Edge edge, std::size_t corner) {
    const auto other = corner_of_edge_.find(edge << 32 | edge >> 32);
    if (other == corner_of_edge_.end()) return;
    fan_[root(corner)] = root(next_corner(other->second));
    fan_[root(next_corner(corner))] = root(other->second);
  }

  static std::size_t next_corner(std::size_t corner) {
    return corner % 3 == 2 ? corner - 2 : corner + 1;
  }

  std::size_t root(std::size_t corner) {
    while (fan_[corner] != corner) corner = fan_[corner] = fan_[fan_[corner]];
    return corner;
  }

  void check_fans() {
    constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);
    std::vector<std::size_t> fan_of_point(soup_.points.size(), kNowhere);
    for (std::size_t corner = 0; corner < fan_.size(); ++corner) {
      const std::uint32_t point = soup_.triangles[corner / 3][corner % 3];
      const std::size_t fan = root(corner);
      if (fan_of_point[point] == kNowhere) fan_of_point[point] = fan;
      if (fan_of_point[point] != fan) {
        refuse(corner / 3, "touches triangles before it only in point " + std::to_string(point));
      }
    }
  }

  const TriangleSoup& soup_;
  std::unordered_map<Edge, std::size_t>
      corner_of_edge_;            // corner: 3 * triangle + where the edge begins
  std::vector<std::size_t> fan_;  // union-find over corners
};

}  // namespace

TriMesh to_openmesh(const TriangleSoup& soup) {
  ManifoldCheck(soup).run();
  TriMesh mesh;
  mesh.reserve(soup.points.size(), 3 * soup.triangles.size() / 2, soup.triangles.size());
  for (const Vec3d& point : soup.points) mesh.add_vertex({point.x(), point.y(), point.z()});
  const auto vertex = [](std::uint32_t index) {
    return TriMesh::VertexHandle(static_cast<int>(index));
  };
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const auto& [a, b, c] = soup.triangles[t];
    if (!mesh.add_face(vertex(a), vertex(b), vertex(c)).is_valid()) {
      refuse(t, "does not fit into a half-edge mesh");
    }
  }
  return mesh;
}

TriangleSoup from_openmesh(const TriMesh& mesh) {
  TriangleSoup soup;
  soup.points.reserve(mesh.n_vertices());
  soup.triangles.reserve(mesh.n_faces());
  std::vector<std::uint32_t> new_index(mesh.n_vertices());
  // The range of `vertices()` leaves out deleted elements, if the mesh has any.
  for (const auto vertex : mesh.vertices()) {
    const TriMesh::Point& point = mesh.point(vertex);
    new_index[static_cast<std::size_t>(vertex.idx())] =
        static_cast<std::uint32_t>(soup.points.size());
    soup.points.emplace_back(point[0], point[1], point[2]);
  }
  for (const auto face : mesh.faces()) {
    std::array<std::uint32_t, 3>& corners = soup.triangles.emplace_back();
    std::size_t i = 0;
    for (const auto vertex : mesh.fv_range(face)) {
      corners[i++] = new_index[static_cast<std::size_t>(vertex.idx())];
    }
  }
  return soup;
}

}  // namespace meshrepair
