// SPDX-License-Identifier: MIT
// From where a mesh is looked at.
#pragma once

#include <optional>
#include <string_view>

namespace meshrepair {

// The way from the middle of the mesh to whoever looks at it. In degrees.
struct View {
  // Around the axis that is up: 0 is the front, 90 the right, 180 the back.
  double azimuth = 45;
  double elevation = 35.264389682754654;  // above the horizon, from -90 to 90; here as for a cube
                                          // of which three faces show alike
  enum class Up { y, z };
  // With z up the front is seen from -y, with y up, as in glTF, from z; x is to the right.
  Up up = Up::z;
};

// "front", "back", "left", "right", "top", "bottom", "iso", or two numbers "AZIMUTH,ELEVATION".
// Nothing if it is none of these.
[[nodiscard]] std::optional<View> view_of(std::string_view text);

}  // namespace meshrepair
