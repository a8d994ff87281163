// SPDX-License-Identifier: MIT
// Volumes that are ranges of one mesh's triangles, as objects.
#pragma once

#include <cstdint>

#include "model_part.h"

namespace meshrepair {

// Of an object that split_volumes() has made.
[[nodiscard]] inline bool is_range_id(std::uint32_t id) { return id >> 31 != 0; }

// Makes each volume of the project that is a range of the object's triangles, and what is left, an
// object of its own; they become components of the object, whose ids no file can name. Points that
// several have are doubled. Ranges that are not there, or begin in one before, are counted as bad.
// n log n.
void split_volumes(ModelPart& part, std::uint32_t object, const ProjectObject& project,
                   ModelOddities& oddities);

}  // namespace meshrepair
