// SPDX-License-Identifier: MIT
#include "summary/volumes_words.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <tuple>

#include "report/words.h"

namespace meshrepair {
namespace {

std::string counted_volumes(std::size_t count, VolumeRole role, bool printed) {
  std::string noun(role_name(role));
  if (role == VolumeRole::model) noun = printed ? "volume" : "unprinted volume";
  return number_of(count, noun,
                   role == VolumeRole::other ? "objects that are not built" : noun + "s");
}

}  // namespace

std::string volumes_words(const std::vector<ModelVolume>& volumes) {
  std::map<std::tuple<VolumeFate, VolumeRole, bool>, std::size_t> counts;
  for (const ModelVolume& volume : volumes) {
    counts[{volume.fate, volume.role, volume.printed}] += volume.copies;
  }
  std::string words;
  for (const auto& [key, count] : counts) {
    const auto& [fate, role, printed] = key;
    if (!words.empty()) words += "; ";
    words += counted_volumes(count, role, printed);
    words += fate == VolumeFate::left_out ? " left out" : " " + std::string(fate_name(fate));
  }
  return words;
}

bool is_difference(const std::vector<ModelVolume>& volumes) {
  return std::any_of(volumes.begin(), volumes.end(), [](const ModelVolume& volume) {
    return volume.fate == VolumeFate::subtracted;
  });
}

}  // namespace meshrepair
