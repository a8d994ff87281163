// SPDX-License-Identifier: MIT
// One unit for several meshes.
#pragma once

#include <optional>

#include <mesh/length_unit.h>
#include <mesh/soup.h>

namespace meshrepair {

// That of the first mesh that says one, unless that of the output is given.
class CommonUnit {
 public:
  // `assumed`: of meshes that say none.
  explicit CommonUnit(std::optional<LengthUnit> assumed,
                      std::optional<LengthUnit> output = std::nullopt)
      : assumed_(assumed), unit_(output) {}

  // Brings the points of a mesh of this unit to it. Returns what lengths are multiplied with.
  double apply(std::optional<LengthUnit> own, TriangleSoup& soup) {
    if (!own) own = assumed_;
    if (!unit_) unit_ = own;
    if (!own) return 1;
    bring_to_unit(*own, *unit_, soup);
    return unit_scale(*own, *unit_);
  }

  [[nodiscard]] std::optional<LengthUnit> get() const { return unit_; }

 private:
  std::optional<LengthUnit> assumed_, unit_;
};

}  // namespace meshrepair
