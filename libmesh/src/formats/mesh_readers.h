// SPDX-License-Identifier: MIT
// Which mesh format a source is in, and the reader that it needs.
#pragma once

#include <mesh/mesh_source.h>
#include <mesh/soup_io.h>

namespace meshrepair {

// By content, then by extension. Throws InputError when it is none that is known.
[[nodiscard]] SoupFormat recognize_mesh(const MeshSource& source);

// What the file holds, which may be nothing.
[[nodiscard]] ReadResult read_mesh_as(SoupFormat format, const MeshSource& source);

// Throws InputError when there are no triangles but there should be, LimitError when there are too
// many.
void require_mesh(const MeshSource& source, const ReadResult& result);

}  // namespace meshrepair
