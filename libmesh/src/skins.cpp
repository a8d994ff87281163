// SPDX-License-Identifier: MIT
#include <algorithm>
#include <charconv>

#include <mesh/skins.h>

namespace meshrepair {

void SkinMixer::add(const double* value, double share) {
  for (std::size_t set = 0; set + kSkinSet <= components_; set += kSkinSet) {
    for (std::size_t i = set; i < set + kSkinSet / 2; ++i) {
      add_joint(value[i], share * value[i + kSkinSet / 2]);
    }
  }
}

void SkinMixer::add_joint(double joint, double weight) {
  if (!(weight > 0)) return;
  const auto known = std::find_if(joints_.begin(), joints_.end(),
                                  [&](const auto& one) { return one.first == joint; });
  if (known == joints_.end()) {
    joints_.emplace_back(joint, weight);
  } else {
    known->second += weight;
  }
}

void SkinMixer::append_to(std::vector<double>& values) {
  std::sort(joints_.begin(), joints_.end(), [](const auto& a, const auto& b) {
    return a.second != b.second ? a.second > b.second : a.first < b.first;
  });
  joints_.resize(std::min(joints_.size(), components_ / 2));
  double sum = 0;
  for (const auto& [joint, weight] : joints_) sum += weight;
  const std::size_t first = values.size();
  values.resize(first + components_, 0);
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    const std::size_t at = first + k / 4 * kSkinSet + k % 4;
    values[at] = joints_[k].first;
    values[at + kSkinSet / 2] = joints_[k].second / sum;
  }
  joints_.clear();
}

std::optional<MorphTarget> morph_target_of(const CornerAttribute& attribute) {
  constexpr std::string_view kBegin = "TARGET_";
  const std::string_view name = attribute.name;
  if (attribute.kind != CornerAttribute::Kind::other || attribute.components != 3 ||
      !name.starts_with(kBegin)) {
    return std::nullopt;
  }
  MorphTarget target;
  const char* const last = name.data() + name.size();
  const auto [end, error] = std::from_chars(name.data() + kBegin.size(), last, target.number);
  if (error != std::errc() || end == last || *end != '/') return std::nullopt;
  if (target.number >= kMostMorphTargets) return std::nullopt;
  target.semantic = name.substr(static_cast<std::size_t>(end - name.data()) + 1);
  const bool is_known =
      target.semantic == "POSITION" || target.semantic == "NORMAL" || target.semantic == "TANGENT";
  return is_known ? std::optional(target) : std::nullopt;
}

}  // namespace meshrepair
