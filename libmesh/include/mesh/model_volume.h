// SPDX-License-Identifier: MIT
// Volumes of a slicer's project: which of them are the model, and what the others are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace meshrepair {

enum class VolumeRole : std::uint8_t {
  model,
  negative,          // what its object does not fill
  modifier,          // where other settings of the print hold
  support_blocker,   // where there is to be no support
  support_enforcer,  // where there is to be one
  support,           // is one itself
  other,             // is not built
};

// "model", "negative volume", "modifier", ...: for people.
[[nodiscard]] std::string_view role_name(VolumeRole role);

enum class VolumeFate : std::uint8_t {
  joined,      // is in the soup
  subtracted,  // the same, to be taken off the volumes of its object
  left_out,
  separate,  // a mesh of its own
};

// "joined", "subtracted", "left_out", "separate".
[[nodiscard]] std::string_view fate_name(VolumeFate fate);

// What to do with negative volumes.
enum class NegativeVolumes : std::uint8_t {
  drop,
  keep,      // as model
  subtract,  // they are in the soup, and ReadResult::placed says where
};

// A volume as its file has it, however often it stands somewhere.
struct ModelVolume {
  std::string name;    // may be empty
  std::string object;  // that it belongs to; may be empty
  VolumeRole role = VolumeRole::model;
  bool printed = true;        // its item is
  std::size_t triangles = 0;  // of one
  std::size_t copies = 0;     // how often it stands somewhere
  VolumeFate fate = VolumeFate::joined;

  // Neither the file nor the reader makes more of it than of any mesh.
  [[nodiscard]] bool is_plain() const { return role == VolumeRole::model && printed; }
};

// "modifier 'a' of the object 'b'": for people.
[[nodiscard]] std::string volume_words(const ModelVolume& volume);

// Triangles of the soup that are one copy of a volume.
struct PlacedVolume {
  std::uint32_t volume = 0;  // of ReadReport::volumes
  std::uint32_t object = 0;  // volumes of one copy of an object have one number
  std::size_t first = 0, triangles = 0;
};

}  // namespace meshrepair
