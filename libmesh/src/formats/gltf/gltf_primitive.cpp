// SPDX-License-Identifier: MIT
#include "gltf_primitive.h"

#include <algorithm>
#include <array>
#include <limits>

#include <base/error.h>
#include <base/ids.h>
#include <mesh/mesh_limits.h>
#include <mesh/read_guard.h>
#include <mesh/skins.h>

#include "gltf_draco.h"
#include "gltf_movement.h"

namespace meshrepair {
namespace {

enum class TriangleMode : std::size_t { triangles = 4, strip = 5, fan = 6 };

class PrimitiveReader {
 public:
  PrimitiveReader(const GltfDocument& document, GltfBuffers& buffers, const GltfJson& primitive,
                  GltfOddities& oddities)
      : document_(document),
        source_(document.source()),
        buffers_(buffers),
        json_(primitive),
        oddities_(oddities),
        guard_(source_) {}

  std::optional<GltfPrimitive> run() {
    const std::size_t mode = document_.whole(json_, "mode", 4);
    if (mode < 4 || mode > 6) {
      ++oddities_.not_triangles;
      return std::nullopt;
    }
    attributes_ = gltf_member(json_, "attributes");
    if (attributes_ == nullptr || gltf_member(*attributes_, "POSITION") == nullptr) {
      ++oddities_.without_positions;
      return std::nullopt;
    }
    result_.material = document_.whole(json_, "material");
    if (result_.material) (void)document_.entry("materials", *result_.material);
    result_.variants = gltf_extension(json_, kGltfVariants);
    const GltfJson* const draco = gltf_extension(json_, "KHR_draco_mesh_compression");
    if (draco != nullptr) {
      read_compressed(*draco);
    } else {
      read_indices();
    }
    read_attributes();
    if (result_.positions.components() != 3) source_.fail("positions have not three coordinates");
    require_same_counts();
    read_targets();
    make_triangles(static_cast<TriangleMode>(mode));
    return std::move(result_);
  }

 private:
  // Integers that are read from it are below its count, or it has none and counts itself.
  void read_indices() {
    const auto number = document_.whole(json_, "indices");
    if (!number) return;
    indices_ = GltfAccessor(document_, buffers_, *number);
    if (!indices_->is_index()) source_.fail("the indices of triangles are no whole numbers");
  }

  void read_compressed(const GltfJson& draco) {
    const auto number = document_.whole(json_, "indices");
    const std::size_t declared =
        number ? document_.required_whole(document_.entry("accessors", *number), "count") / 3
               : std::numeric_limits<std::size_t>::max();
    guard_.require(number ? declared : 0);
    std::vector<DracoAttribute> wanted;
    std::vector<std::string> names;
    const GltfJson* const ids = gltf_member(draco, "attributes");
    if (ids == nullptr || !ids->is_object())
      source_.fail("compressed triangles name no attributes");
    for (const auto& [name, id] : ids->items()) {
      if (!is_wanted(name)) continue;
      const auto accessor = document_.whole(*attributes_, name.c_str());
      if (!accessor) continue;
      const GltfLayout layout =
          GltfAccessor::layout_of(document_, document_.entry("accessors", *accessor));
      const std::size_t id_number = document_.whole_of(id, "attribute");
      wanted.push_back({static_cast<std::uint32_t>(id_number), layout.normalized});
      names.push_back(name);
    }
    DracoMesh mesh = decode_draco(
        source_, buffers_.view(document_.required_whole(draco, "bufferView")), declared, wanted);
    for (std::size_t i = 0; i < names.size(); ++i) {
      take(names[i], std::move(mesh.attributes[i]));
    }
    corners_ = std::move(mesh.corners);
  }

  [[nodiscard]] bool is_wanted(const std::string& name) const {
    return name == "POSITION" || source_.options.attributes;
  }

  void take(const std::string& name, GltfAccessor accessor) {
    if (name == "POSITION") {
      result_.positions = std::move(accessor);
      has_positions_ = true;
    } else {
      result_.attributes.emplace_back(name, std::move(accessor));
    }
  }

  void read_attributes() {
    for (const auto& [name, value] : attributes_->items()) {
      if (!is_wanted(name) || has(name) || name.starts_with(kGltfTarget)) continue;
      take(name, GltfAccessor(document_, buffers_, document_.whole_of(value, "attribute")));
    }
  }

  [[nodiscard]] bool has(const std::string& name) const {
    if (name == "POSITION") return has_positions_;
    return std::any_of(result_.attributes.begin(), result_.attributes.end(),
                       [&](const auto& attribute) { return attribute.first == name; });
  }

  void require_same_counts() const {
    const std::size_t points = result_.positions.count();
    for (const auto& [name, accessor] : result_.attributes) {
      if (accessor.count() == points) continue;
      source_.fail("a primitive has " + counted(accessor.count(), "value") + " of " +
                   printable(name) + " for " + counted(points, "point"));
    }
  }

  // What is wrong with them harms nothing else.
  void read_targets() {
    const GltfJson* const targets = gltf_member(json_, "targets");
    if (targets == nullptr) return;
    bool is_whole = source_.options.attributes && !corners_ && targets->is_array() &&
                    targets->size() <= kMostMorphTargets;
    for (std::size_t i = 0; is_whole && i < targets->size(); ++i) {
      if (!(*targets)[i].is_object()) continue;
      for (const auto& [name, number] : (*targets)[i].items()) {
        is_whole = read_target(kGltfTarget + std::to_string(i) + "/" + name, number) && is_whole;
      }
    }
    if (!is_whole) ++oddities_.morphed;
  }

  bool read_target(const std::string& name, const GltfJson& number) {
    try {
      GltfAccessor accessor(document_, buffers_, document_.whole_of(number, "attribute"));
      if (accessor.count() != result_.positions.count()) return false;
      result_.attributes.emplace_back(name, std::move(accessor));
    } catch (const InputError&) {
      return false;
    }
    return true;
  }

  [[nodiscard]] std::size_t corner_count() const {
    if (corners_) return corners_->size();
    return indices_ ? indices_->count() : result_.positions.count();
  }

  [[nodiscard]] std::size_t vertex_at(std::size_t corner) const {
    if (corners_) return (*corners_)[corner];
    return indices_ ? indices_->index(corner) : corner;
  }

  void make_triangles(TriangleMode mode) {
    // What Draco gives is triangles, whatever they were.
    if (corners_) mode = TriangleMode::triangles;
    const std::size_t count = corner_count();
    const std::size_t triangles =
        mode == TriangleMode::triangles ? count / 3 : std::max<std::size_t>(count, 2) - 2;
    guard_.require(triangles);
    require_points(result_.positions.count(), source_.name);
    number_.assign(result_.positions.count(), kNone);
    result_.corners.reserve(3 * triangles);
    for (std::size_t t = 0; t < triangles; ++t) {
      guard_.step(t, 0);
      if (mode == TriangleMode::triangles) {
        add(3 * t, 3 * t + 1, 3 * t + 2);
      } else if (mode == TriangleMode::strip) {
        add_of_strip(t, t + 1 + t % 2, t + 2 - t % 2);
      } else {
        add(t + 1, t + 2, 0);
      }
    }
    number_ = {};
    if (mode == TriangleMode::triangles && count % 3 != 0) ++oddities_.bad_triangles;
  }

  // Strips go on through triangles that are none.
  void add_of_strip(std::size_t a, std::size_t b, std::size_t c) {
    const std::size_t va = vertex_at(a), vb = vertex_at(b), vc = vertex_at(c);
    if (va != vb && vb != vc && vc != va) add(a, b, c);
  }

  void add(std::size_t a, std::size_t b, std::size_t c) {
    const std::array<std::size_t, 3> vertices = {vertex_at(a), vertex_at(b), vertex_at(c)};
    if (std::any_of(vertices.begin(), vertices.end(),
                    [&](std::size_t v) { return v >= number_.size(); })) {
      ++oddities_.bad_triangles;
      return;
    }
    for (const std::size_t vertex : vertices) {
      std::uint32_t& number = number_[vertex];
      if (number == kNone) {
        number = static_cast<std::uint32_t>(result_.vertices.size());
        result_.vertices.push_back(static_cast<std::uint32_t>(vertex));
      }
      result_.corners.push_back(number);
    }
  }

  const GltfDocument& document_;
  const MeshSource& source_;
  GltfBuffers& buffers_;
  const GltfJson& json_;
  GltfOddities& oddities_;
  ReadGuard guard_;
  const GltfJson* attributes_ = nullptr;
  std::optional<GltfAccessor> indices_;
  std::optional<std::vector<std::uint32_t>> corners_;  // decompressed
  bool has_positions_ = false;
  std::vector<std::uint32_t> number_;  // of each vertex, among those in use
  GltfPrimitive result_;
};

}  // namespace

void GltfOddities::report(ReadReport& report) const {
  const auto warn = [&](WarningCode code, std::size_t count, std::string_view noun,
                        std::string_view what) {
    if (count == 0) return;
    report.warnings.push_back(
        {code, counted(count, noun) + " " + std::string(what), {{"count", count}}});
  };
  report.bad_faces += bad_triangles;
  warn(WarningCode::content_ignored, not_triangles, "primitive", "of points or lines left out");
  warn(WarningCode::content_ignored, without_positions, "primitive", "without positions left out");
  warn(WarningCode::faces_unreadable, bad_triangles, "triangle",
       "left out: corners that are not there");
  warn(WarningCode::attributes_unreadable, morphed, "primitive", "read without morph targets");
}

std::optional<GltfPrimitive> read_primitive(const GltfDocument& document, GltfBuffers& buffers,
                                            const GltfJson& primitive, GltfOddities& oddities) {
  return PrimitiveReader(document, buffers, primitive, oddities).run();
}

}  // namespace meshrepair
