// SPDX-License-Identifier: MIT
#include "gltf_values.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include <Eigen/Geometry>

#include <base/error.h>
#include <base/roots.h>
#include <mesh/precision.h>
#include <mesh/skins.h>

namespace meshrepair {
namespace {

// What a name stands for, and which of its kind.
struct Semantic {
  CornerAttribute::Kind kind;
  std::size_t number;
};

std::optional<Semantic> semantic_of(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, CornerAttribute::Kind>, 2> kNumbered = {
      {{"TEXCOORD_", CornerAttribute::Kind::texture}, {"COLOR_", CornerAttribute::Kind::colour}}};
  if (name == "NORMAL") return Semantic{CornerAttribute::Kind::normal, 0};
  if (name == "TANGENT") return Semantic{CornerAttribute::Kind::tangent, 0};
  if (name.starts_with('_')) return Semantic{CornerAttribute::Kind::other, 0};
  if (name == "JOINTS_0") return Semantic{CornerAttribute::Kind::skin, 0};
  for (const auto& [begin, kind] : kNumbered) {
    if (!name.starts_with(begin)) continue;
    const char* const last = name.data() + name.size();
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(name.data() + begin.size(), last, number);
    if (error == std::errc() && end == last) return Semantic{kind, number};
  }
  return std::nullopt;
}

std::size_t components_of(CornerAttribute::Kind kind, std::size_t in_file) {
  switch (kind) {
    case CornerAttribute::Kind::texture:
      return 2;
    case CornerAttribute::Kind::normal:
      return 3;
    case CornerAttribute::Kind::tangent:
      return 4;
    case CornerAttribute::Kind::colour:
      return std::clamp<std::size_t>(in_file, 3, 4);
    case CornerAttribute::Kind::skin:
    case CornerAttribute::Kind::other:
      break;
  }
  return in_file;
}

// Of length 1, as single precision, unless it has no direction.
void set_direction(std::vector<double>& value, const Vec3d& direction) {
  const double length = stable_length(direction);
  if (!std::isfinite(length) || !(length > 0)) return;
  for (int i = 0; i < 3; ++i) {
    value[static_cast<std::size_t>(i)] = rounded_to_float32(direction[i] / length);
  }
}

// The cofactors are the transposed inverse times the determinant, and exist without it.
Vec3d turned_normal(const Eigen::Matrix3d& m, const Vec3d& normal) {
  Eigen::Matrix3d cofactors;
  cofactors.col(0) = m.col(1).cross(m.col(2));
  cofactors.col(1) = m.col(2).cross(m.col(0));
  cofactors.col(2) = m.col(0).cross(m.col(1));
  const Vec3d turned = cofactors * normal;
  return m.determinant() < 0 ? Vec3d(-turned) : turned;
}

const GltfAccessor* find_accessor(const GltfPrimitive& primitive, const std::string& name) {
  const auto found = std::find_if(primitive.attributes.begin(), primitive.attributes.end(),
                                  [&](const auto& attribute) { return attribute.first == name; });
  return found == primitive.attributes.end() ? nullptr : &found->second;
}

std::vector<GltfSkinSet> skin_sets_of(const GltfPrimitive& primitive) {
  constexpr std::size_t kMostSets = 8;
  std::vector<GltfSkinSet> sets;
  while (sets.size() < kMostSets) {
    const std::string number = std::to_string(sets.size());
    const GltfSkinSet set{find_accessor(primitive, "JOINTS_" + number),
                          find_accessor(primitive, "WEIGHTS_" + number)};
    if (set.joints == nullptr || set.weights == nullptr || set.joints->components() != 4 ||
        set.weights->components() != 4) {
      break;
    }
    sets.push_back(set);
  }
  return sets;
}

bool is_joint(double number) {
  constexpr double kMost = std::numeric_limits<std::uint16_t>::max();
  return number >= 0 && number <= kMost && number == std::floor(number);
}

}  // namespace

GltfValues::GltfValues(const std::vector<const GltfPrimitive*>& primitives) {
  std::map<Key, CornerAttribute> found;
  for (const GltfPrimitive* primitive : primitives) {
    for (const auto& [name, accessor] : primitive->attributes) {
      auto semantic = semantic_of(name);
      CornerAttribute named;
      named.kind = CornerAttribute::Kind::other;
      named.name = name;
      named.components = accessor.components();
      if (morph_target_of(named)) semantic = Semantic{CornerAttribute::Kind::other, 0};
      if (!semantic) continue;
      std::size_t components = components_of(semantic->kind, accessor.components());
      if (semantic->kind == CornerAttribute::Kind::skin) {
        components = kSkinSet * skin_sets_of(*primitive).size();
        if (components == 0) continue;
      }
      const bool is_byte =
          semantic->kind == CornerAttribute::Kind::colour && accessor.is_byte_share();
      const CornerAttribute::Storage storage =
          is_byte ? CornerAttribute::Storage::byte : CornerAttribute::Storage::real32;
      const auto [at, is_new] = found.try_emplace({semantic->kind, {semantic->number, name}});
      CornerAttribute& set = at->second;
      set.components = is_new ? components : std::max(set.components, components);
      set.storage = is_new || set.storage == storage ? storage : CornerAttribute::Storage::real32;
      set.kind = semantic->kind;
      set.name = name;
      set.place = CornerAttribute::Place::point;
    }
  }
  for (auto& [key, attribute] : found) {
    sets_.emplace_back();
    sets_.back().attribute = std::move(attribute);
  }
}

void GltfValues::append(const GltfPrimitive& primitive, const Placement& placement,
                        const std::vector<std::uint32_t>& corners) {
  std::vector<std::uint32_t> number_of(primitive.vertices.size());
  for (std::size_t s = 0; s < sets_.size(); ++s) {
    Set& set = sets_[s];
    const GltfAccessor* const own = find_accessor(primitive, set.attribute.name);
    const bool is_skin = set.attribute.kind == CornerAttribute::Kind::skin;
    const std::vector<GltfSkinSet> skins =
        is_skin ? skin_sets_of(primitive) : std::vector<GltfSkinSet>();
    std::vector<std::uint32_t>& of_corner = set.attribute.of_corner;
    if (own == nullptr || (is_skin && skins.empty())) {
      of_corner.resize(of_corner.size() + corners.size(), kNone);
      continue;
    }
    for (std::size_t v = 0; v < number_of.size(); ++v) {
      if (is_skin) {
        fill_skin(skins, primitive.vertices[v], set.attribute.components);
      } else {
        fill(*own, primitive.vertices[v], placement, s);
      }
      number_of[v] = number_of_value(set);
    }
    for (const std::uint32_t corner : corners) of_corner.push_back(number_of[corner]);
  }
}

void GltfValues::fill(const GltfAccessor& accessor, std::uint32_t vertex,
                      const Placement& placement, std::size_t set) {
  const CornerAttribute& attribute = sets_[set].attribute;
  value_.assign(attribute.components, attribute.kind == CornerAttribute::Kind::colour ? 1 : 0);
  const std::size_t count = std::min(attribute.components, accessor.components());
  for (std::size_t k = 0; k < count; ++k) {
    const double number = accessor.value(vertex, k);
    value_[k] =
        attribute.storage == CornerAttribute::Storage::byte ? number : rounded_to_float32(number);
  }
  if (attribute.kind == CornerAttribute::Kind::texture) {
    const double v = value_[1];
    value_[1] = 1 - v;
    small_v_.add(set, value_[0], value_[1], static_cast<float>(v));
  } else if (attribute.kind == CornerAttribute::Kind::normal && !placement.is_identity()) {
    set_direction(value_, turned_normal(placement.linear, {value_[0], value_[1], value_[2]}));
  } else if (attribute.kind == CornerAttribute::Kind::tangent && !placement.is_identity()) {
    set_direction(value_, placement.linear * Vec3d(value_[0], value_[1], value_[2]));
    if (placement.linear.determinant() < 0) value_[3] = -value_[3];
  } else if (const auto target = morph_target_of(attribute); target && !placement.is_identity()) {
    turn_difference(placement, target->semantic);
  }
}

// What is added to directions grows no more than these do: they have length 1 before and after.
void GltfValues::turn_difference(const Placement& placement, std::string_view semantic) {
  const Vec3d difference(value_[0], value_[1], value_[2]);
  const double scale = cube_root(std::abs(placement.linear.determinant()));
  Vec3d turned = placement.linear * difference;
  if (semantic == "NORMAL") turned = turned_normal(placement.linear, difference) / (scale * scale);
  if (semantic == "TANGENT") turned /= scale;
  if (!turned.allFinite()) turned.setZero();
  for (int i = 0; i < 3; ++i) value_[static_cast<std::size_t>(i)] = rounded_to_float32(turned[i]);
}

// Joints that are no numbers of any have no weight.
void GltfValues::fill_skin(const std::vector<GltfSkinSet>& sets, std::uint32_t vertex,
                           std::size_t components) {
  value_.assign(components, 0);
  for (std::size_t s = 0; s < sets.size(); ++s) {
    for (std::size_t k = 0; k < 4; ++k) {
      const double joint = sets[s].joints->value(vertex, k);
      const double weight = sets[s].weights->value(vertex, k);
      if (!is_joint(joint) || !std::isfinite(weight)) continue;
      value_[kSkinSet * s + k] = joint;
      value_[kSkinSet * s + 4 + k] = rounded_to_float32(weight);
    }
  }
}

std::uint32_t GltfValues::number_of_value(Set& set) {
  std::vector<double>& values = set.attribute.values;
  const std::size_t n = set.attribute.components;
  const auto hash_at = [n](const double* at) {
    std::uint64_t hash = 0;
    for (std::size_t k = 0; k < n; ++k) {
      hash = internal::hash_mix(hash, std::bit_cast<std::uint64_t>(at[k]));
    }
    return hash;
  };
  const auto same = [&](std::uint32_t number) {
    return std::equal(value_.begin(), value_.end(), values.data() + n * number,
                      [](double a, double b) {
                        return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
                      });
  };
  const auto fresh = static_cast<std::uint32_t>(values.size() / n);
  if (fresh == kNone) throw LimitError("more than 4294967294 values of an attribute");
  if (set.numbers.full(fresh)) {
    set.numbers.grow(fresh, [&](std::uint32_t i) { return hash_at(values.data() + n * i); });
  }
  const std::uint32_t number = set.numbers.find_or_insert(hash_at(value_.data()), fresh, same);
  if (number == fresh) values.insert(values.end(), value_.begin(), value_.end());
  return number;
}

std::vector<CornerAttribute> GltfValues::take_corners() {
  std::vector<CornerAttribute> corners;
  for (Set& set : sets_) corners.push_back(std::move(set.attribute));
  sets_.clear();
  return corners;
}

}  // namespace meshrepair
