// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <base/angles.h>
#include <mesh/placed_pictures.h>

namespace meshrepair {
namespace {

// How the picture of a material takes its coordinates.
struct Placing {
  std::uint32_t set = 0;
  TextureTransform transform;

  bool operator==(const Placing&) const = default;
};

Placing placing_of(const Material& look) {
  return look.image == kNone ? Placing() : Placing{look.texture_set, look.transform};
}

// As KHR_texture_transform says: v is turned downwards, and back.
void move_values(const TextureTransform& transform, double* first, const double* last,
                 std::size_t components) {
  const auto [cosine, sine] = cosine_and_sine(transform.rotation);
  for (; first != last; first += components) {
    const double u = transform.scale[0] * first[0];
    const double v = transform.scale[1] * (1 - first[1]);
    first[0] = cosine * u + sine * v + transform.offset[0];
    first[1] = 1 - (cosine * v - sine * u + transform.offset[1]);
  }
}

// Makes one set of coordinates out of several.
class PictureSet {
 public:
  PictureSet(const Attributes& attributes, const std::vector<Placing>& placings)
      : materials_(attributes.materials), placings_(placings) {
    for (const CornerAttribute& attribute : attributes.corners) {
      if (attribute.kind == CornerAttribute::Kind::texture) sets_.push_back(&attribute);
    }
    if (sets_.empty()) return;
    result_.components = sets_.front()->components;
    result_.place = sets_.front()->place;
    result_.storage = sets_.front()->storage;
  }

  // Of all triangles. What a set that is not there would say is nothing.
  CornerAttribute run() {
    for (std::size_t t = 0; t < materials_.of_triangle.size(); ++t) {
      const std::uint32_t material = materials_.of_triangle[t];
      add_triangle(t, material < placings_.size() ? placings_[material] : Placing());
    }
    share_values(result_);
    return std::move(result_);
  }

 private:
  void add_triangle(std::size_t t, const Placing& placing) {
    const CornerAttribute* const set = placing.set < sets_.size() ? sets_[placing.set] : nullptr;
    const std::uint32_t first = set == nullptr ? 0 : first_value(placing, *set);
    for (std::size_t k = 3 * t; k < 3 * t + 3; ++k) {
      const std::uint32_t value = set == nullptr ? kNone : set->of_corner[k];
      result_.of_corner.push_back(value == kNone ? kNone : first + value);
    }
  }

  // Of the set's values, moved so: one placing after the other has all of its set.
  std::uint32_t first_value(const Placing& placing, const CornerAttribute& set) {
    const auto known = std::find_if(blocks_.begin(), blocks_.end(),
                                    [&](const auto& block) { return block.first == placing; });
    if (known != blocks_.end()) return known->second;
    const std::size_t n = result_.components, at = result_.values.size();
    const auto first = static_cast<std::uint32_t>(at / n);
    for (std::size_t i = 0; i < set.count(); ++i) {
      for (std::size_t k = 0; k < n; ++k) {
        result_.values.push_back(k < set.components ? set.values[set.components * i + k] : 0);
      }
    }
    if (placing.transform != TextureTransform()) {
      move_values(placing.transform, result_.values.data() + at,
                  result_.values.data() + result_.values.size(), n);
      result_.storage = CornerAttribute::Storage::real64;
    }
    if (set.place != result_.place) result_.place = CornerAttribute::Place::corner;
    if (set.storage != result_.storage) result_.storage = CornerAttribute::Storage::real64;
    blocks_.emplace_back(placing, first);
    return first;
  }

  const TriangleLabels& materials_;
  const std::vector<Placing>& placings_;
  std::vector<const CornerAttribute*> sets_;
  std::vector<std::pair<Placing, std::uint32_t>> blocks_;
  CornerAttribute result_;
};

}  // namespace

std::optional<Attributes> with_placed_pictures(const Attributes& attributes,
                                               const std::unordered_set<std::string>& but) {
  if (find_kind(attributes, CornerAttribute::Kind::texture) == nullptr) return std::nullopt;
  std::vector<Placing> placings;
  for (std::size_t m = 0; m < attributes.looks.size(); ++m) {
    const Material& look = attributes.looks[m];
    const bool is_placed = !but.empty() && but.contains(attributes.materials.names[m]);
    placings.push_back(is_placed ? Placing{look.texture_set, {}} : placing_of(look));
  }
  const bool are_all = std::all_of(placings.begin(), placings.end(),
                                   [](const Placing& one) { return one == Placing(); });
  if (are_all) return std::nullopt;
  Attributes placed = attributes;
  CornerAttribute set = PictureSet(attributes, placings).run();
  // Texture coordinates come before all others.
  if (set.count() > 0) placed.corners.insert(placed.corners.begin(), std::move(set));
  for (Material& look : placed.looks) {
    look.texture_set = 0;
    look.transform = {};
  }
  return placed;
}

}  // namespace meshrepair
