// SPDX-License-Identifier: MIT
// Zstandard: frames, one behind the other, some of which are to be skipped.
#pragma once

#include <string>
#include <string_view>

#include <base/progress.h>
#include <mesh/mesh_source.h>

#include "unpack_target.h"

namespace meshrepair {

// With a frame of either kind.
[[nodiscard]] bool begins_with_zstd(std::string_view bytes);

// Returns what is behind the last frame. Throws InputError, Cancelled.
[[nodiscard]] std::string_view unpack_zstd(const MeshSource& source, UnpackTarget& target);

// One frame with a checksum. `progress` may be null. Throws Cancelled.
[[nodiscard]] std::string pack_zstd(std::string_view bytes, ProgressObserver* progress);

}  // namespace meshrepair
