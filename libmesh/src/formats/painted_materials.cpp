// SPDX-License-Identifier: MIT
#include "painted_materials.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <mesh/triangle_paint.h>

namespace meshrepair {

const TrianglePaint* filament_paint(const Attributes& attributes) {
  const auto found = std::find_if(
      attributes.paints.begin(), attributes.paints.end(), [](const TrianglePaint& paint) {
        return paint.name == "paint_color" || paint.name == "slic3rpe:mmu_segmentation";
      });
  return found == attributes.paints.end() ? nullptr : &*found;
}

void make_materials_of_paint(Attributes& attributes) {
  const TrianglePaint* const paint = filament_paint(attributes);
  if (paint == nullptr || paint->codes.empty() || !attributes.materials.empty()) return;
  std::map<std::uint32_t, std::uint32_t> number_of;  // materials of filaments, which count from 1
  std::vector<std::uint32_t> filament_of_code;
  for (const std::string& code : paint->codes.names) {
    filament_of_code.push_back(PaintCode(code).main_state().value_or(0));
    if (filament_of_code.back() > 0) number_of.emplace(filament_of_code.back(), 0);
  }
  for (auto& [filament, number] : number_of) {
    number = static_cast<std::uint32_t>(attributes.materials.names.size());
    attributes.materials.names.push_back("filament " + std::to_string(filament));
    Material look;
    if (filament <= attributes.filaments.size()) look.colour = attributes.filaments[filament - 1];
    attributes.looks.push_back(look);
  }
  for (const std::uint32_t code : paint->codes.of_triangle) {
    const std::uint32_t filament = code == kNone ? 0 : filament_of_code[code];
    attributes.materials.of_triangle.push_back(filament == 0 ? kNone : number_of.at(filament));
  }
}

}  // namespace meshrepair
