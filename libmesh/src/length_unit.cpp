// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include <mesh/length_unit.h>

namespace meshrepair {
namespace {

struct UnitFacts {
  LengthUnit unit;
  std::string_view name;
  double millimeters;
};

constexpr std::array<UnitFacts, 6> kUnits = {{{LengthUnit::micron, "micron", 0.001},
                                              {LengthUnit::millimeter, "millimeter", 1},
                                              {LengthUnit::centimeter, "centimeter", 10},
                                              {LengthUnit::inch, "inch", 25.4},
                                              {LengthUnit::foot, "foot", 304.8},
                                              {LengthUnit::meter, "meter", 1000}}};

}  // namespace

double millimeters(LengthUnit unit) { return kUnits[static_cast<std::size_t>(unit)].millimeters; }

double unit_scale(LengthUnit from, LengthUnit to) { return millimeters(from) / millimeters(to); }

void bring_to_unit(LengthUnit from, LengthUnit to, TriangleSoup& soup) {
  if (from == to) return;
  const double scale = unit_scale(from, to);
  for (Vec3d& point : soup.points) point *= scale;
}

std::string_view unit_name(LengthUnit unit) { return kUnits[static_cast<std::size_t>(unit)].name; }

std::optional<LengthUnit> unit_named(std::string_view name) {
  const auto* const found = std::find_if(kUnits.begin(), kUnits.end(),
                                         [&](const UnitFacts& one) { return one.name == name; });
  return found == kUnits.end() ? std::nullopt : std::optional(found->unit);
}

}  // namespace meshrepair
