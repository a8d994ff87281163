// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include <base/ids.h>
#include <mesh/append_soup.h>
#include <mesh/scene.h>
#include <mesh/triangle_paint.h>

namespace meshrepair {
namespace {

// Puts entries, `each` of them for a triangle, into the order of the triangles.
template <class T>
void reorder(std::vector<T>& entries, const std::vector<std::uint32_t>& order, std::size_t each) {
  if (entries.empty()) return;
  std::vector<T> sorted;
  sorted.reserve(entries.size());
  for (const std::uint32_t t : order) {
    const auto first = entries.begin() + static_cast<std::ptrdiff_t>(each * t);
    sorted.insert(sorted.end(), first, first + static_cast<std::ptrdiff_t>(each));
  }
  entries = std::move(sorted);
}

void reorder(Attributes& attributes, const std::vector<std::uint32_t>& order) {
  for (CornerAttribute& attribute : attributes.corners) reorder(attribute.of_corner, order, 3);
  for (TriangleLabels* labels :
       {&attributes.materials, &attributes.groups, &attributes.objects, &attributes.smoothing}) {
    reorder(labels->of_triangle, order, 1);
  }
  for (TrianglePaint& paint : attributes.paints) reorder(paint.codes.of_triangle, order, 1);
}

// Of each triangle its object, or as many as there are objects.
std::vector<std::uint32_t> objects_of(const TriangleSoup& soup, const Attributes& attributes) {
  const auto none = static_cast<std::uint32_t>(attributes.objects.names.size());
  std::vector<std::uint32_t> object(soup.triangles.size(), none);
  if (attributes.objects.empty()) return object;
  for (std::size_t t = 0; t < object.size(); ++t) {
    object[t] = std::min(attributes.objects.of_triangle[t], none);
  }
  return object;
}

// Copies of the points that triangles of the mesh have, behind those that are there.
class PointCopier {
 public:
  explicit PointCopier(std::vector<Vec3d> points)
      : points_(std::move(points)), mesh_of_copy_(points_.size(), kNone), copy_(points_.size()) {}

  void copy(std::uint32_t mesh, std::array<std::uint32_t, 3>& corners, std::vector<Vec3d>& to) {
    for (std::uint32_t& corner : corners) {
      if (mesh_of_copy_[corner] != mesh) {
        mesh_of_copy_[corner] = mesh;
        copy_[corner] = static_cast<std::uint32_t>(to.size());
        to.push_back(points_[corner]);
      }
      corner = copy_[corner];
    }
  }

 private:
  std::vector<Vec3d> points_;
  std::vector<std::uint32_t> mesh_of_copy_, copy_;  // the last of each point
};

}  // namespace

std::vector<TriangleSoup> meshes_of(const TriangleSoup& soup, const Scene& scene) {
  std::vector<TriangleSoup> meshes;
  meshes.reserve(scene.meshes.size());
  auto point = soup.points.begin();
  auto triangle = soup.triangles.begin();
  for (const SceneMesh& one : scene.meshes) {
    const auto first = static_cast<std::uint32_t>(point - soup.points.begin());
    const auto point_end = point + static_cast<std::ptrdiff_t>(one.points);
    const auto triangle_end = triangle + static_cast<std::ptrdiff_t>(one.triangles);
    TriangleSoup& mesh = meshes.emplace_back();
    mesh.points.assign(point, point_end);
    mesh.triangles.assign(triangle, triangle_end);
    for (auto& corners : mesh.triangles) {
      for (std::uint32_t& corner : corners) corner -= first;
    }
    point = point_end;
    triangle = triangle_end;
  }
  return meshes;
}

Scene split_objects(TriangleSoup& soup, Attributes& attributes) {
  const std::vector<std::uint32_t> object = objects_of(soup, attributes);
  std::vector<std::uint32_t> order(soup.triangles.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return object[a] < object[b]; });
  reorder(soup.triangles, order, 1);
  reorder(attributes, order);
  Scene scene;
  PointCopier copier(std::exchange(soup.points, {}));
  std::uint32_t last = kNone;
  std::size_t points_before = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::uint32_t now = object[order[i]];
    if (scene.meshes.empty() || now != last) {
      const bool has_name = now < attributes.objects.names.size();
      const std::string name = has_name ? attributes.objects.names[now] : std::string();
      scene.instances.push_back({static_cast<std::uint32_t>(scene.meshes.size()), name, {}});
      scene.meshes.push_back({name, 0, 0});
      points_before = soup.points.size();
      last = now;
    }
    copier.copy(now, soup.triangles[i], soup.points);
    scene.meshes.back().points = soup.points.size() - points_before;
    ++scene.meshes.back().triangles;
  }
  return scene;
}

void place_instances(TriangleSoup& soup, Attributes& attributes, const Scene& scene) {
  if (scene.meshes.empty()) return;
  std::vector<std::uint32_t> first = {0};
  for (const SceneMesh& mesh : scene.meshes) {
    first.push_back(first.back() + static_cast<std::uint32_t>(mesh.triangles));
  }
  const std::vector<TriangleSoup> meshes = meshes_of(soup, scene);
  std::vector<std::uint32_t> order;
  std::vector<std::size_t> turned;  // triangles that are seen in a mirror
  soup = {};
  for (const auto& [mesh, name, placement] : scene.instances) {
    const std::size_t before = soup.triangles.size();
    append_soup(soup, meshes[mesh], placement);
    for (std::size_t t = before; placement.mirrors() && t < soup.triangles.size(); ++t) {
      turned.push_back(t);
    }
    for (std::uint32_t t = first[mesh]; t < first[mesh + 1]; ++t) order.push_back(t);
  }
  reorder(attributes, order);
  for (CornerAttribute& attribute : attributes.corners) {
    for (const std::size_t t : turned) {
      std::swap(attribute.of_corner[3 * t + 1], attribute.of_corner[3 * t + 2]);
    }
  }
  for (TrianglePaint& paint : attributes.paints) turn_paint(paint, turned);
}

bool is_plain(const Scene& scene) {
  std::vector<std::size_t> stands(scene.meshes.size(), 0);
  for (const SceneInstance& instance : scene.instances) {
    if (!instance.placement.is_identity()) return false;
    ++stands[instance.mesh];
  }
  return std::all_of(stands.begin(), stands.end(), [](std::size_t count) { return count == 1; });
}

}  // namespace meshrepair
