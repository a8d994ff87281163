// SPDX-License-Identifier: MIT
// gzip: members, each with a checksum, one behind the other.
#pragma once

#include <string>
#include <string_view>

#include <base/progress.h>
#include <mesh/mesh_source.h>

#include "unpack_target.h"

namespace meshrepair {

[[nodiscard]] bool begins_with_gzip(std::string_view bytes);

// Returns what is behind the last member. Throws InputError, Cancelled.
[[nodiscard]] std::string_view unpack_gzip(const MeshSource& source, UnpackTarget& target);

// One member, without a time or a name. `progress` may be null. Throws Cancelled.
[[nodiscard]] std::string pack_gzip(std::string_view bytes, ProgressObserver* progress);

}  // namespace meshrepair
