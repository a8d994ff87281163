// SPDX-License-Identifier: MIT
#include "page/pack_looks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <base/base64.h>
#include <base/ids.h>
#include <mesh/packing.h>
#include <mesh/placed_pictures.h>

#include "page/packed_numbers.h"

namespace meshrepair {
namespace {

constexpr double kStepsOfPicture = 8192;
constexpr double kFarthest = 10'000;  // from the picture that repeats

const CornerAttribute* find_usable(const Attributes& attributes, CornerAttribute::Kind kind,
                                   std::size_t components) {
  const CornerAttribute* const found = find_kind(attributes, kind);
  return found != nullptr && found->components >= components ? found : nullptr;
}

// Programs that know of no colours write black ones, too.
bool is_black(const CornerAttribute& colours) {
  for (std::size_t i = 0; i < colours.values.size(); ++i) {
    if (i % colours.components < 3 && colours.values[i] > 0) return false;
  }
  return true;
}

std::uint32_t byte_of(double share) {
  return static_cast<std::uint32_t>(std::lround((share > 0 ? std::min(share, 1.0) : 0) * 255));
}

std::int32_t step_of(double place) {
  const double within = std::isfinite(place) ? std::clamp(place, -kFarthest, kFarthest) : 0;
  return static_cast<std::int32_t>(std::lround(within * kStepsOfPicture));
}

// Values in the order in which corners have them first.
class ValueOrder {
 public:
  explicit ValueOrder(const CornerAttribute& attribute)
      : attribute_(attribute), number_of_(attribute.count(), kNone) {}

  [[nodiscard]] std::uint32_t value_at(std::uint32_t triangle, std::size_t corner) const {
    return attribute_.of_corner[3 * std::size_t{triangle} + corner];
  }

  // 0: the next new one; k: the one that came k before that.
  std::uint32_t back_to(std::uint32_t value) {
    const auto next = static_cast<std::uint32_t>(order_.size());
    if (number_of_[value] != kNone) return next - number_of_[value];
    number_of_[value] = next;
    order_.push_back(value);
    return 0;
  }

  [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }
  [[nodiscard]] double component(std::uint32_t value, std::size_t i) const {
    return attribute_.values[attribute_.components * value + i];
  }

 private:
  const CornerAttribute& attribute_;
  std::vector<std::uint32_t> number_of_, order_;
};

class LooksPacker {
 public:
  LooksPacker(const Attributes& attributes, const DrawnMesh& drawn)
      : attributes_(attributes),
        drawn_(drawn),
        places_(find_usable(attributes, CornerAttribute::Kind::texture, 2)),
        colours_(find_usable(attributes, CornerAttribute::Kind::colour, 3)) {
    if (colours_ != nullptr && is_black(*colours_)) colours_ = nullptr;
  }

  [[nodiscard]] bool says_nothing() const {
    return colours_ == nullptr && (attributes_.looks.empty() || attributes_.materials.empty());
  }

  PackedLooks run(PagePictures& pictures, ProgressObserver* progress) {
    find_pictures(pictures);
    add_materials();
    if (has_pictures_) add_places();
    if (colours_ != nullptr) add_colours();
    PackedLooks packed;
    packed.facts = {{"materials", facts_of_materials()},
                    {"has_places", has_pictures_},
                    {"has_colours", colours_ != nullptr}};
    packed.text = encode_base64(pack_bytes(bytes_, Packing::gzip, progress));
    return packed;
  }

 private:
  [[nodiscard]] std::uint32_t material_of(std::uint32_t triangle) const {
    const auto& materials = attributes_.materials.of_triangle;
    const std::uint32_t material = triangle < materials.size() ? materials[triangle] : kNone;
    return material < attributes_.looks.size() ? material : kNone;
  }

  // Of the materials that are drawn.
  void find_pictures(PagePictures& pictures) {
    picture_of_.resize(attributes_.looks.size());
    std::vector<char> asked(attributes_.looks.size(), 0);
    for (const std::uint32_t t : drawn_.source) {
      const std::uint32_t material = material_of(t);
      if (places_ == nullptr || material == kNone || asked[material] != 0) continue;
      asked[material] = 1;
      const std::uint32_t image = attributes_.looks[material].image;
      if (image < attributes_.images.size()) {
        picture_of_[material] = pictures.number_of(attributes_.images[image]);
      }
    }
  }

  [[nodiscard]] bool has_places(std::uint32_t triangle) const {
    const auto first = places_->of_corner.begin() + 3 * static_cast<std::ptrdiff_t>(triangle);
    return std::none_of(first, first + 3, [](std::uint32_t value) { return value == kNone; });
  }
  [[nodiscard]] bool has_picture(std::uint32_t triangle) const {
    const std::uint32_t material = material_of(triangle);
    return material != kNone && picture_of_[material].has_value() && has_places(triangle);
  }

  void add_materials() {
    for (const std::uint32_t t : drawn_.source) {
      const std::uint32_t material = material_of(t);
      const bool pictured = has_picture(t);
      has_pictures_ |= pictured;
      append_number(bytes_, material == kNone ? 0 : 2 * (material + 1) + (pictured ? 1 : 0));
    }
  }

  void add_places() {
    ValueOrder values(*places_);
    for (const std::uint32_t t : drawn_.source) {
      if (!has_picture(t)) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        append_number(bytes_, values.back_to(values.value_at(t, k)));
      }
    }
    for (std::size_t i = 0; i < 2; ++i) {
      std::int32_t before = 0;
      for (const std::uint32_t value : values.order()) {
        const std::int32_t now = step_of(values.component(value, i));
        append_signed(bytes_, now - before);
        before = now;
      }
    }
  }

  void add_colours() {
    ValueOrder values(*colours_);
    for (const std::uint32_t t : drawn_.source) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t value = values.value_at(t, k);
        append_number(bytes_, value == kNone ? 0 : values.back_to(value) + 1);
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      for (const std::uint32_t value : values.order()) {
        append_number(bytes_, byte_of(values.component(value, i)));
      }
    }
  }

  [[nodiscard]] Json facts_of_materials() const {
    Json list = Json::array();
    for (std::size_t m = 0; m < attributes_.looks.size(); ++m) {
      const Material& look = attributes_.looks[m];
      Json facts = {
          {"colour", {byte_of(look.colour[0]), byte_of(look.colour[1]), byte_of(look.colour[2])}}};
      if (picture_of_[m]) {
        facts["picture"] = *picture_of_[m];
        facts["wrap"] = {wrap_word(look.sampling.wrap[0]), wrap_word(look.sampling.wrap[1])};
        facts["nearest"] = look.sampling.filter == TextureSampling::Filter::nearest;
      }
      list.push_back(std::move(facts));
    }
    return list;
  }

  static std::string_view wrap_word(TextureSampling::Wrap wrap) {
    switch (wrap) {
      case TextureSampling::Wrap::repeat:
        return "repeat";
      case TextureSampling::Wrap::mirror:
        return "mirror";
      default:
        return "clamp";
    }
  }

  const Attributes& attributes_;
  const DrawnMesh& drawn_;
  const CornerAttribute* places_;   // in pictures; null: none
  const CornerAttribute* colours_;  // null: none
  std::vector<std::optional<std::size_t>> picture_of_;
  bool has_pictures_ = false;
  std::string bytes_;
};

}  // namespace

std::optional<PackedLooks> pack_looks(const Attributes& attributes, const DrawnMesh& drawn,
                                      PagePictures& pictures, ProgressObserver* progress) {
  const std::optional<Attributes> placed = with_placed_pictures(attributes);
  LooksPacker packer(placed ? *placed : attributes, drawn);
  if (packer.says_nothing()) return std::nullopt;
  return packer.run(pictures, progress);
}

}  // namespace meshrepair
