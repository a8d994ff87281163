// SPDX-License-Identifier: MIT
// How points move with joints and towards morph targets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <mesh/attributes.h>

namespace meshrepair {

// Of values of the kind `skin`: four numbers of joints and four weights, and so on.
inline constexpr std::size_t kSkinSet = 8;

// Makes a value of the kind `skin` of others: each joint gets the mean of its weights. Of more
// joints than a value holds, those with the largest weights stay, and weights add up to 1. Joints
// are in the order of their weights, equal ones in that of their numbers.
class SkinMixer {
 public:
  explicit SkinMixer(std::size_t components) : components_(components) {}

  void add(const double* value, double share);
  void add_joint(double joint, double weight);
  // Appends the value, and begins another.
  void append_to(std::vector<double>& values);

 private:
  std::size_t components_;
  std::vector<std::pair<double, double>> joints_;  // and their weights
};

// Files with few bytes could name very large numbers, and all below are written.
inline constexpr std::size_t kMostMorphTargets = 4096;

// What a morph target adds to, and its number below kMostMorphTargets. Such attributes are `other`
// ones with names like "TARGET_0/POSITION", of three numbers; nothing for others.
struct MorphTarget {
  std::uint32_t number = 0;
  std::string_view semantic;  // POSITION, NORMAL or TANGENT
};
[[nodiscard]] std::optional<MorphTarget> morph_target_of(const CornerAttribute& attribute);

}  // namespace meshrepair
