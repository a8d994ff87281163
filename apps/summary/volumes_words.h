// SPDX-License-Identifier: MIT
// What became of the volumes of a slicer's project.
#pragma once

#include <string>
#include <vector>

#include <mesh/model_volume.h>

namespace meshrepair {

// "2 joined; 1 negative volume subtracted; 3 modifiers left out", for people; empty where there are
// none.
[[nodiscard]] std::string volumes_words(const std::vector<ModelVolume>& volumes);

// Whether the mesh in hand is not that of the file: negative volumes are subtracted from it.
[[nodiscard]] bool is_difference(const std::vector<ModelVolume>& volumes);

}  // namespace meshrepair
