// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <base/error.h>
#include <mesh/mesh_limits.h>
#include <mesh/read_guard.h>
#include <mesh/weld_points.h>

#include "gltf_io.h"
#include "gltf_keepsake.h"
#include "gltf_materials.h"
#include "gltf_movement.h"
#include "gltf_primitive.h"
#include "gltf_scene.h"
#include "gltf_values.h"

namespace meshrepair {
namespace {

class GltfReader {
 public:
  explicit GltfReader(const MeshSource& source)
      : source_(source), document_(source), buffers_(document_), guard_(source) {}

  ReadResult run() {
    result_.report.format = document_.is_binary() ? SoupFormat::glb : SoupFormat::gltf;
    result_.report.unit = LengthUnit::meter;
    instances_ = read_scene(document_, buffers_);
    if (!is_by_mesh()) leave_out_hidden();
    read_meshes();
    leave_out_targets();
    GltfValues values(primitives());
    read_labels();
    if (is_by_mesh()) {
      list_meshes(values);
    } else {
      join_instances(values);
    }
    guard_.step(result_.soup.triangles.size(), source_.bytes.size());
    finish(values);
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool wants_attributes() const { return source_.options.attributes; }
  [[nodiscard]] bool is_by_mesh() const { return source_.options.by_mesh; }

  void leave_out_hidden() {
    std::string names;
    std::size_t count = 0;
    std::erase_if(instances_, [&](const GltfInstance& instance) {
      if (!instance.is_hidden) return false;
      shown_or_hidden_.insert(instance.node);
      constexpr std::size_t kMostNames = 8;
      const std::string name = name_of(instance);
      if (!name.empty() && count < kMostNames)
        names += (names.empty() ? "" : ", ") + printable(name);
      ++count;
      return true;
    });
    if (count == 0) return;
    result_.report.warnings.push_back(
        {WarningCode::objects_left_out,
         counted(count, "node") + " with meshes left out: hidden (--scene each keeps them)" +
             (names.empty() ? "" : ": " + names),
         {{"count", count}}});
  }

  // Files may have them of very few bytes.
  void leave_out_targets() {
    constexpr std::size_t kAlways = 10'000'000;
    std::set<std::string_view> names;
    std::size_t corners = 0;
    for (const auto& [number, primitives] : meshes_) {
      for (const GltfPrimitive& primitive : primitives) {
        for (const auto& [name, accessor] : primitive.attributes) {
          if (name.starts_with(kGltfTarget)) names.insert(name);
        }
        if (is_by_mesh()) corners += primitive.corners.size();
      }
    }
    if (names.empty()) return;
    if (!is_by_mesh()) corners = 3 * count_triangles();
    if (corners <= (kAlways + source_.bytes.size()) / names.size()) return;
    names.clear();
    for (auto& [number, primitives] : meshes_) {
      for (GltfPrimitive& primitive : primitives) {
        const auto gone = std::erase_if(primitive.attributes, [](const auto& attribute) {
          return attribute.first.starts_with(kGltfTarget);
        });
        if (gone > 0) ++oddities_.morphed;
      }
    }
  }

  // Those of the scene, or all.
  void read_meshes() {
    if (is_by_mesh()) {
      for (std::size_t m = 0; m < document_.count("meshes"); ++m) read_mesh(m);
    } else {
      for (const GltfInstance& instance : instances_) {
        if (!meshes_.contains(instance.mesh)) read_mesh(instance.mesh);
      }
    }
  }

  void read_mesh(std::size_t number) {
    std::vector<GltfPrimitive>& primitives = meshes_[number];
    const GltfJson* const list = gltf_member(document_.entry("meshes", number), "primitives");
    if (list == nullptr || !list->is_array()) return;
    for (const GltfJson& json : *list) {
      guard_.step(0, 0);
      auto primitive = read_primitive(document_, buffers_, json, oddities_);
      if (!primitive) continue;
      guard_.require(read_ += primitive->triangles());
      primitives.push_back(std::move(*primitive));
    }
  }

  void join_instances(GltfValues& values) {
    const std::size_t triangles = count_triangles();
    result_.soup.triangles.reserve(triangles);
    PointWelder welder(result_.soup.points, triangles / 2);
    for (const GltfInstance& instance : instances_) {
      const std::uint32_t object = object_named(name_of(instance));
      keep_object(instance);
      for (const GltfPrimitive& primitive : meshes_[instance.mesh]) {
        append(primitive, instance.placement, object, welder, values);
      }
    }
  }

  void list_meshes(GltfValues& values) {
    TriangleSoup& soup = result_.soup;
    soup.triangles.reserve(read_);
    Scene& scene = result_.scene;
    for (const GltfInstance& instance : instances_) {
      // A number that is too large was refused.
      (void)document_.entry("meshes", instance.mesh);
      scene.instances.push_back({static_cast<std::uint32_t>(instance.mesh),
                                 gltf_text(document_.entry("nodes", instance.node), "name"),
                                 instance.placement});
    }
    for (const auto& [number, primitives] : meshes_) {
      SceneMesh mesh{gltf_text(document_.entry("meshes", number), "name"), 0, 0};
      const std::uint32_t object = object_named(mesh.name);
      std::vector<Vec3d> points;
      const std::size_t first_point = soup.points.size(), first = soup.triangles.size();
      PointWelder welder(points);
      for (const GltfPrimitive& primitive : primitives) {
        append(primitive, {}, object, welder, values);
      }
      for (std::size_t t = first; t < soup.triangles.size(); ++t) {
        for (std::uint32_t& corner : soup.triangles[t]) {
          corner += static_cast<std::uint32_t>(first_point);
        }
      }
      soup.points.insert(soup.points.end(), points.begin(), points.end());
      require_points(soup.points.size(), source_.name);
      mesh.points = points.size();
      mesh.triangles = soup.triangles.size() - first;
      scene.meshes.push_back(std::move(mesh));
    }
  }

  [[nodiscard]] std::vector<const GltfPrimitive*> primitives() const {
    std::vector<const GltfPrimitive*> all;
    for (const auto& [number, mesh] : meshes_) {
      for (const GltfPrimitive& primitive : mesh) all.push_back(&primitive);
    }
    return all;
  }

  // Instances are cheap in the file, so they are counted before memory is taken.
  std::size_t count_triangles() const {
    std::map<std::size_t, std::size_t> of_mesh;
    for (const auto& [number, mesh] : meshes_) {
      for (const GltfPrimitive& primitive : mesh) of_mesh[number] += primitive.triangles();
    }
    std::size_t count = 0;
    for (const GltfInstance& instance : instances_) {
      count += of_mesh[instance.mesh];
      require_triangles(count, source_.name);
    }
    guard_.require(count);
    return count;
  }

  void read_labels() {
    if (wants_attributes()) read_materials(document_, buffers_, result_.attributes);
    if (!wants_attributes() && !is_by_mesh()) return;
    kept_ = make_gltf_keepsake(document_, buffers_, result_.attributes,
                               {is_by_mesh(), wants_attributes()});
    if (wants_attributes()) keep_variants();
  }

  // Triangles of one material become one primitive.
  void keep_variants() {
    std::set<std::pair<std::size_t, std::size_t>> mixed;
    std::map<std::pair<std::size_t, std::size_t>, const GltfJson*> first;
    for (const auto& [number, primitives] : meshes_) {
      for (const GltfPrimitive& primitive : primitives) {
        const std::pair key(is_by_mesh() ? number : 0, primitive.material.value_or(kNone));
        const GltfJson* const known = first.try_emplace(key, primitive.variants).first->second;
        const GltfJson* const own = primitive.variants;
        const bool is_same = known == own || (known != nullptr && own != nullptr && *known == *own);
        if (!is_same) mixed.insert(key);
      }
    }
    for (const auto& [key, variants] : first) {
      if (variants != nullptr && !mixed.contains(key)) kept_->variants.emplace(key, *variants);
    }
    if (mixed.empty()) return;
    result_.report.warnings.push_back({WarningCode::attributes_unreadable,
                                       "the variants of " + counted(mixed.size(), "material") +
                                           " left out: primitives have different ones",
                                       {{"materials", mixed.size()}}});
  }

  // Where several of one name differ, none is told.
  void keep_object(const GltfInstance& instance) {
    if (!wants_attributes()) return;
    const GltfJson& mesh = document_.entry("meshes", instance.mesh);
    GltfObject own;
    if (instance.has_skin)
      own.skin = document_.whole(document_.entry("nodes", instance.node), "skin");
    for (const char* key : {"weights", "extras"}) {
      if (const GltfJson* const member = gltf_member(mesh, key)) own.mesh[key] = *member;
    }
    const auto [known, is_new] = kept_->objects.try_emplace(name_of(instance), own);
    GltfObject& all = known->second;
    if (all.skin != own.skin) mixed_skins_.insert(known->first);
    if (all.skin != own.skin) all.skin.reset();
    if (all.mesh != own.mesh) all.mesh = GltfJson();
  }

  [[nodiscard]] std::string name_of(const GltfInstance& instance) const {
    std::string name = gltf_text(document_.entry("nodes", instance.node), "name");
    return name.empty() ? gltf_text(document_.entry("meshes", instance.mesh), "name") : name;
  }

  std::uint32_t object_named(const std::string& name) {
    if (!wants_attributes() || name.empty()) return kNone;
    std::vector<std::string>& names = result_.attributes.objects.names;
    const auto [found, is_new] =
        objects_.try_emplace(name, static_cast<std::uint32_t>(names.size()));
    if (is_new) names.push_back(name);
    return found->second;
  }

  void append(const GltfPrimitive& primitive, const Placement& placement, std::uint32_t object,
              PointWelder& welder, GltfValues& values) {
    const std::vector<std::uint32_t> points = add_points(primitive, placement, welder);
    // Seen in a mirror triangles turn.
    const bool is_mirrored = placement.mirrors();
    std::vector<std::uint32_t> turned;
    if (is_mirrored) {
      turned = primitive.corners;
      for (std::size_t i = 0; i < turned.size(); i += 3) std::swap(turned[i + 1], turned[i + 2]);
    }
    const std::vector<std::uint32_t>& corners = is_mirrored ? turned : primitive.corners;
    for (std::size_t i = 0; i < corners.size(); i += 3) {
      guard_.step(result_.soup.triangles.size(), 0);
      result_.soup.triangles.push_back(
          {points[corners[i]], points[corners[i + 1]], points[corners[i + 2]]});
    }
    if (!wants_attributes()) return;
    values.append(primitive, placement, corners);
    const std::size_t size = result_.soup.triangles.size();
    const std::size_t material = primitive.material.value_or(kNone);
    result_.attributes.materials.of_triangle.resize(size, static_cast<std::uint32_t>(material));
    result_.attributes.objects.of_triangle.resize(size, object);
  }

  static std::vector<std::uint32_t> add_points(const GltfPrimitive& primitive,
                                               const Placement& placement, PointWelder& welder) {
    const bool is_moved = !placement.is_identity();
    std::vector<std::uint32_t> points;
    points.reserve(primitive.vertices.size());
    for (const std::uint32_t vertex : primitive.vertices) {
      const GltfAccessor& positions = primitive.positions;
      Vec3d point(positions.value(vertex, 0), positions.value(vertex, 1),
                  positions.value(vertex, 2));
      if (is_moved) point = placement.of(point);
      points.push_back(welder.index_of(point));
    }
    return points;
  }

  void finish(GltfValues& values) {
    ReadReport& report = result_.report;
    oddities_.report(report);
    warn_of_skins();
    if (!is_by_mesh()) warn_of_other_scenes();
    report.trailing_bytes = document_.trailing_bytes();
    if (report.trailing_bytes > 0) {
      report.warnings.push_back(
          bytes_ignored(report.trailing_bytes, "after the end of the binary glTF"));
    }
    Attributes& attributes = result_.attributes;
    if (!wants_attributes()) {
      attributes.keepsake = std::move(kept_);
      return;
    }
    attributes.corners = values.take_corners();
    if (attributes.materials.names.empty()) attributes.materials = {};
    if (attributes.objects.names.empty()) attributes.objects = {};
    kept_->small_v = values.take_small_v();
    attributes.keepsake = std::move(kept_);
  }

  void warn_of_skins() {
    const bool has_skins = std::any_of(instances_.begin(), instances_.end(),
                                       [](const auto& instance) { return instance.has_skin; });
    std::vector<Warning>& warnings = result_.report.warnings;
    if (has_skins && !wants_attributes()) {
      warnings.push_back(
          {WarningCode::attributes_unreadable, "meshes with skins are read as without joints"});
    }
    if (wants_attributes() && kept_->still_channels > 0) {
      warnings.push_back({WarningCode::attributes_lost,
                          counted(kept_->still_channels, "channel") +
                              " of animations left out: what they move is not kept" +
                              (is_by_mesh() ? "" : " (--scene each keeps morph targets)"),
                          {{"channels", kept_->still_channels}}});
    }
    if (mixed_skins_.empty()) return;
    warnings.push_back({WarningCode::attributes_lost,
                        counted(mixed_skins_.size(), "object") +
                            " without a skin, as parts of one name have different ones",
                        {{"objects", mixed_skins_.size()}}});
  }

  void warn_of_other_scenes() {
    std::unordered_set<std::size_t> shown = shown_or_hidden_;
    for (const GltfInstance& instance : instances_) shown.insert(instance.node);
    std::size_t others = 0;
    for (std::size_t n = 0; n < document_.count("nodes"); ++n) {
      const bool has_mesh = gltf_member(document_.entry("nodes", n), "mesh") != nullptr;
      if (has_mesh && !shown.contains(n)) ++others;
    }
    if (others == 0) return;
    result_.report.warnings.push_back(
        {WarningCode::objects_left_out,
         counted(others, "node") + " with meshes left out: not in the scene that is shown",
         {{"count", others}}});
  }

  const MeshSource& source_;
  GltfDocument document_;
  GltfBuffers buffers_;
  ReadGuard guard_;
  std::vector<GltfInstance> instances_;
  GltfOddities oddities_;
  std::map<std::size_t, std::vector<GltfPrimitive>> meshes_;
  std::size_t read_ = 0;  // triangles, before instances
  std::unordered_map<std::string, std::uint32_t> objects_;
  std::unordered_set<std::size_t> shown_or_hidden_;  // nodes
  std::set<std::string> mixed_skins_;                // names of objects
  std::shared_ptr<GltfKeepsake> kept_;
  ReadResult result_;
};

}  // namespace

bool is_glb(std::string_view bytes) { return bytes.starts_with("glTF"); }

bool is_gltf_text(std::string_view bytes) {
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && bytes[first] == '{' &&
         bytes.find("\"asset\"") != std::string_view::npos;
}

ReadResult read_gltf(const MeshSource& source) { return GltfReader(source).run(); }

}  // namespace meshrepair
