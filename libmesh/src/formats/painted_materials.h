// SPDX-License-Identifier: MIT
// Painted filaments, for formats that have materials and no paint.
#pragma once

#include <mesh/attributes.h>

namespace meshrepair {

// Of the paints the one that says which filament triangles are of; null: none.
[[nodiscard]] const TrianglePaint* filament_paint(const Attributes& attributes);

// Where there are no materials, makes one of each filament that is painted, and gives triangles
// that of most of their area.
void make_materials_of_paint(Attributes& attributes);

}  // namespace meshrepair
