// SPDX-License-Identifier: MIT
#include "gltf_vertices.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <utility>

#include <Eigen/Geometry>

#include <base/error.h>
#include <base/internal/hash_index.h>
#include <base/roots.h>
#include <mesh/skins.h>

#include "formats/common/written_float.h"

namespace meshrepair {
namespace {

// glTF has no values that are not finite.
float value_to_float(double value) {
  if (std::isnan(value)) return 0;
  constexpr double kMost = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -kMost, kMost));
}

std::size_t written_components(const CornerAttribute& attribute) {
  const std::size_t n = attribute.components;
  switch (attribute.kind) {
    case CornerAttribute::Kind::texture:
      return n >= 2 ? 2 : 0;
    case CornerAttribute::Kind::normal:
      return n == 3 ? 3 : 0;
    case CornerAttribute::Kind::tangent:
      return n == 4 ? 4 : 0;
    case CornerAttribute::Kind::colour:
      return n == 3 || n == 4 ? n : 0;
    case CornerAttribute::Kind::skin:
      return 4;
    case CornerAttribute::Kind::other:
      break;
  }
  return (n >= 1 && n <= 4) || n == 9 || n == 16 ? n : 0;
}

// "_NAME" in the letters that glTF asks for; another number behind it if there is one already.
std::string name_of_other(const std::string& name, std::set<std::string>& taken) {
  std::string clean = name.starts_with('_') ? "" : "_";
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    clean += byte < 128 && std::isalnum(byte) != 0 ? c : '_';
  }
  if (clean == "_") clean = "_VALUE";
  std::string unique = clean;
  for (int i = 1; !taken.insert(unique).second; ++i) unique = clean + "_" + std::to_string(i);
  return unique;
}

// An attribute that is written.
struct WrittenSet {
  const CornerAttribute* attribute;
  std::string name;
  std::size_t number;  // among those of its kind
  std::size_t components;
  std::size_t first = 0;  // of the components of the attribute
  bool is_used = false;

  [[nodiscard]] bool is_joints() const {
    return attribute->kind == CornerAttribute::Kind::skin && first % kSkinSet == 0;
  }
  [[nodiscard]] bool is_of_mesh() const {
    return attribute->kind == CornerAttribute::Kind::skin || morph_target_of(*attribute);
  }
};

// Joints and weights of each set.
void add_skin(const CornerAttribute& attribute, std::vector<WrittenSet>& sources) {
  for (std::size_t set = 0; (set + 1) * kSkinSet <= attribute.components; ++set) {
    const std::string number = std::to_string(set);
    sources.push_back({&attribute, "JOINTS_" + number, set, 4, kSkinSet * set});
    sources.push_back({&attribute, "WEIGHTS_" + number, set, 4, kSkinSet * set + 4});
  }
}

std::vector<WrittenSet> sources_of(const Attributes& attributes) {
  std::vector<WrittenSet> sources;
  std::set<std::string> taken;
  std::array<std::size_t, 6> counts{};
  for (const CornerAttribute& attribute : attributes.corners) {
    const std::size_t components = written_components(attribute);
    const std::size_t number = counts[static_cast<std::size_t>(attribute.kind)];
    const bool is_single = attribute.kind == CornerAttribute::Kind::normal ||
                           attribute.kind == CornerAttribute::Kind::tangent ||
                           attribute.kind == CornerAttribute::Kind::skin;
    if (components == 0 || attribute.of_corner.empty() || (is_single && number > 0)) continue;
    ++counts[static_cast<std::size_t>(attribute.kind)];
    std::string name;
    switch (attribute.kind) {
      case CornerAttribute::Kind::texture:
        name = "TEXCOORD_" + std::to_string(number);
        break;
      case CornerAttribute::Kind::normal:
        name = "NORMAL";
        break;
      case CornerAttribute::Kind::tangent:
        name = "TANGENT";
        break;
      case CornerAttribute::Kind::colour:
        name = "COLOR_" + std::to_string(number);
        break;
      case CornerAttribute::Kind::skin:
        add_skin(attribute, sources);
        continue;
      case CornerAttribute::Kind::other:
        name = morph_target_of(attribute) ? attribute.name : name_of_other(attribute.name, taken);
        break;
    }
    sources.push_back({&attribute, std::move(name), number, components});
  }
  return sources;
}

class VertexMaker {
 public:
  VertexMaker(const TriangleSoup& soup, std::span<const std::uint32_t> triangles,
              const Attributes* attributes, const GltfKeepsake* kept, const GltfNeeds& needs)
      : soup_(soup), triangles_(triangles), kept_(kept), needs_(needs) {
    if (attributes != nullptr) sources_ = used(with_needed_textures(sources_of(*attributes)));
  }

  GltfVertices run() {
    add_columns();
    internal::HashIndex index(triangles_.size() / 2);
    for (const std::uint32_t t : triangles_) {
      for (std::size_t k = 0; k < 3; ++k) {
        fill_record(t, k);
        vertices_.corners.push_back(number_of_record(index));
      }
    }
    vertices_.count = records_.size() / record_.size();
    split_records();
    return std::move(vertices_);
  }

 private:
  // Sets that nobody has are without values.
  [[nodiscard]] std::vector<WrittenSet> with_needed_textures(std::vector<WrittenSet> all) const {
    static const CornerAttribute no_values;
    const auto is_texture = [](const WrittenSet& source) {
      return source.attribute->kind == CornerAttribute::Kind::texture;
    };
    auto count = static_cast<std::size_t>(std::count_if(all.begin(), all.end(), is_texture));
    for (; count < needs_.textures; ++count) {
      all.push_back({&no_values, "TEXCOORD_" + std::to_string(count), count, 2});
    }
    return all;
  }

  [[nodiscard]] bool is_used(const WrittenSet& source) const {
    const CornerAttribute& attribute = *source.attribute;
    if (attribute.kind == CornerAttribute::Kind::texture && source.number < needs_.textures) {
      return true;
    }
    const auto& of_corner = attribute.of_corner;
    const auto triangles = source.is_of_mesh() ? needs_.of_mesh : triangles_;
    return std::any_of(triangles.begin(), triangles.end(), [&](std::size_t t) {
      return of_corner[3 * t] != kNone || of_corner[3 * t + 1] != kNone ||
             of_corner[3 * t + 2] != kNone;
    });
  }

  // Those below a set that is used are written, too: sets are numbered from 0 on.
  std::vector<WrittenSet> used(std::vector<WrittenSet> all) const {
    for (WrittenSet& source : all) source.is_used = is_used(source);
    std::vector<WrittenSet> kept;
    for (const WrittenSet& source : all) {
      const bool is_below = std::any_of(all.begin(), all.end(), [&](const WrittenSet& other) {
        return other.is_used && other.attribute->kind == source.attribute->kind &&
               source.attribute->kind != CornerAttribute::Kind::other &&
               other.number > source.number;
      });
      if (source.is_used || is_below) kept.push_back(source);
    }
    return kept;
  }

  void add_columns() {
    vertices_.columns.push_back({"POSITION", {GltfComponent::real32, false, 3, 3}, 12, {}});
    for (const WrittenSet& source : sources_) {
      const bool is_byte = source.attribute->kind == CornerAttribute::Kind::colour &&
                           source.attribute->storage == CornerAttribute::Storage::byte;
      GltfLayout layout{is_byte ? GltfComponent::uint8 : GltfComponent::real32, is_byte,
                        source.components, source.components};
      if (source.is_joints()) layout.component = joint_component(*source.attribute);
      const std::size_t stride = (layout.size() + 3) / 4 * 4;
      vertices_.columns.push_back({source.name, layout, stride, {}});
    }
    std::size_t size = 0;
    for (const GltfColumn& column : vertices_.columns) size += column.stride;
    record_.assign(size, '\0');
  }

  static GltfComponent joint_component(const CornerAttribute& skin) {
    constexpr double kMost = std::numeric_limits<std::uint8_t>::max();
    for (std::size_t i = 0; i < skin.values.size(); ++i) {
      if (i % kSkinSet < 4 && skin.values[i] > kMost) return GltfComponent::uint16;
    }
    return GltfComponent::uint8;
  }

  void fill_record(std::size_t t, std::size_t k) {
    const Vec3d& point = soup_.points[soup_.triangles[t][k]];
    char* at = record_.data();
    const auto put = [&](float value) {
      std::memcpy(at, &value, sizeof value);
      at += sizeof value;
    };
    for (const double coordinate : point) put(written_float(coordinate, "glTF"));
    for (std::size_t s = 0; s < sources_.size(); ++s) {
      const GltfColumn& column = vertices_.columns[s + 1];
      fill_value(sources_[s], t, k);
      if (column.layout.component == GltfComponent::real32) {
        for (const float value : value_) put(value);
        continue;
      }
      const std::size_t size = size_of(column.layout.component);
      for (std::size_t i = 0; i < value_.size(); ++i) {
        const float share = column.layout.normalized ? 255 * std::clamp(value_[i], 0.0f, 1.0f)
                                                     : std::clamp(value_[i], 0.0f, 65535.0f);
        const auto number = static_cast<std::uint16_t>(std::lround(share));
        std::memcpy(at + size * i, &number, size);
      }
      at += column.stride;
    }
  }

  void fill_value(const WrittenSet& source, std::size_t t, std::size_t k) {
    const CornerAttribute& attribute = *source.attribute;
    const std::uint32_t number =
        attribute.of_corner.empty() ? kNone : attribute.of_corner[3 * t + k];
    value_.assign(source.components, attribute.kind == CornerAttribute::Kind::colour ? 1.0f : 0.0f);
    if (number != kNone) {
      const double* const given =
          attribute.values.data() + attribute.components * number + source.first;
      for (std::size_t i = 0; i < value_.size(); ++i) value_[i] = value_to_float(given[i]);
      if (attribute.kind == CornerAttribute::Kind::texture)
        value_[1] = downwards(source, given[0], given[1]);
    }
    if (attribute.kind == CornerAttribute::Kind::skin && number == kNone) {
      value_[0] = source.first == 4 ? 1.0f : 0.0f;  // it moves with the first joint
    } else if (attribute.kind == CornerAttribute::Kind::normal) {
      make_unit(normal_of(t));
    } else if (attribute.kind == CornerAttribute::Kind::tangent) {
      make_unit({1, 0, 0});
      value_[3] = value_[3] < 0 ? -1.0f : 1.0f;
    }
  }

  [[nodiscard]] float downwards(const WrittenSet& source, double u, double v) const {
    if (kept_ != nullptr)
      return value_to_float(double{kept_->small_v.original(source.number, u, v)});
    return value_to_float(1 - v);
  }

  [[nodiscard]] Vec3d normal_of(std::size_t t) const {
    const auto& [a, b, c] = soup_.triangles[t];
    const Vec3d normal =
        (soup_.points[b] - soup_.points[a]).cross(soup_.points[c] - soup_.points[a]);
    const double length = stable_length(normal);
    return std::isfinite(length) && length > 0 ? Vec3d(normal / length) : Vec3d(0, 0, 1);
  }

  // Those that are nearly of length 1 keep their bits.
  void make_unit(const Vec3d& otherwise) {
    constexpr double kNearly = 1e-4;
    const Vec3d given(double{value_[0]}, double{value_[1]}, double{value_[2]});
    const double length = stable_length(given);
    if (std::abs(length - 1) <= kNearly) return;
    const Vec3d unit = length > 0 ? Vec3d(given / length) : otherwise;
    for (int i = 0; i < 3; ++i) value_[static_cast<std::size_t>(i)] = static_cast<float>(unit[i]);
  }

  std::uint32_t number_of_record(internal::HashIndex& index) {
    const std::size_t size = record_.size();
    const auto hash_at = [size](const char* at) {
      std::uint64_t hash = 0;
      for (std::size_t i = 0; i < size; i += 4) {
        std::uint32_t word = 0;
        std::memcpy(&word, at + i, sizeof word);
        hash = internal::hash_mix(hash, word);
      }
      return hash;
    };
    const std::size_t fresh = records_.size() / size;
    if (fresh >= kNone) throw OutputError("glTF holds no more than 4294967294 vertices");
    const auto number = static_cast<std::uint32_t>(fresh);
    if (index.full(fresh)) {
      index.grow(number, [&](std::size_t i) { return hash_at(records_.data() + size * i); });
    }
    const std::uint32_t found =
        index.find_or_insert(hash_at(record_.data()), number, [&](std::size_t i) {
          return std::memcmp(records_.data() + size * i, record_.data(), size) == 0;
        });
    if (found == number) records_ += record_;
    return found;
  }

  void split_records() {
    std::size_t offset = 0;
    for (GltfColumn& column : vertices_.columns) {
      column.bytes.reserve(column.stride * vertices_.count);
      for (std::size_t i = 0; i < vertices_.count; ++i) {
        column.bytes.append(records_, record_.size() * i + offset, column.stride);
      }
      offset += column.stride;
    }
    records_ = {};
  }

  const TriangleSoup& soup_;
  std::span<const std::uint32_t> triangles_;
  const GltfKeepsake* kept_;
  const GltfNeeds& needs_;
  std::vector<WrittenSet> sources_;
  std::string records_;  // of the vertices, all columns of one side by side
  std::string record_;   // of the corner that is looked at
  std::vector<float> value_;
  GltfVertices vertices_;
};

}  // namespace

GltfVertices make_vertices(const TriangleSoup& soup, std::span<const std::uint32_t> triangles,
                           const Attributes* attributes, const GltfKeepsake* kept,
                           const GltfNeeds& needs) {
  return VertexMaker(soup, triangles, attributes, kept, needs).run();
}

}  // namespace meshrepair
