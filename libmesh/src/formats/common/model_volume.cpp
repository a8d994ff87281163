// SPDX-License-Identifier: MIT
#include <array>

#include <mesh/mesh_source.h>
#include <mesh/model_volume.h>

namespace meshrepair {

std::string_view role_name(VolumeRole role) {
  constexpr std::array<std::string_view, 7> kNames = {
      "model",   "negative volume",         "modifier", "support blocker", "support enforcer",
      "support", "object that is not built"};
  return kNames.at(static_cast<std::size_t>(role));
}

std::string_view fate_name(VolumeFate fate) {
  constexpr std::array<std::string_view, 4> kNames = {"joined", "subtracted", "left_out",
                                                      "separate"};
  return kNames.at(static_cast<std::size_t>(fate));
}

std::string volume_words(const ModelVolume& volume) {
  std::string words(role_name(volume.role));
  if (volume.role == VolumeRole::model) words = "volume";
  if (!volume.name.empty()) words += " '" + printable(volume.name) + "'";
  if (!volume.object.empty() && volume.object != volume.name) {
    words += " of the object '" + printable(volume.object) + "'";
  }
  return words;
}

}  // namespace meshrepair
