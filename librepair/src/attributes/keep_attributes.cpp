// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include <base/ids.h>
#include <base/parallel.h>
#include <repair/transfer_attributes.h>

#include "common/continuity.h"

namespace meshrepair {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// How much attributes change along each triangle.
class Steepness {
 public:
  Steepness(const TriangleSoup& input, const CornerAttribute& attribute)
      : input_(input), attribute_(attribute), extent_(internal::extent_of(attribute)) {}

  // Shares of the extent for a unit of length, in the steepest direction. Infinite where the
  // triangle has no area, as then it is no function of the place.
  [[nodiscard]] double operator()(std::size_t t) const {
    const std::uint32_t* const value = attribute_.of_corner.data() + 3 * t;
    const bool has_all = std::none_of(value, value + 3, [](std::uint32_t v) { return v == kNone; });
    if (!has_all || !(extent_ > 0)) return 0;
    const std::array<std::uint32_t, 3>& corners = input_.triangles[t];
    const Vec3d ab = input_.points[corners[1]] - input_.points[corners[0]];
    const Vec3d ac = input_.points[corners[2]] - input_.points[corners[0]];
    double squares = 0;
    for (std::size_t i = 0; i < attribute_.components; ++i) {
      const auto at = [&](std::size_t k) {
        return attribute_.values[attribute_.components * value[k] + i] / extent_;
      };
      squares += (ac * (at(1) - at(0)) - ab * (at(2) - at(0))).squaredNorm();
    }
    if (squares == 0) return 0;
    return std::sqrt(squares) / ab.cross(ac).norm();
  }

 private:
  const TriangleSoup& input_;
  const CornerAttribute& attribute_;
  double extent_;
};

}  // namespace

void keep_attributes(const TriangleSoup& input, const Attributes& attributes,
                     RepairOptions& options) {
  if (attributes.is_bare()) return;
  options.extract.merges_triangles = false;
  options.reach.assign(input.triangles.size(), kInfinity);
  for (const CornerAttribute& attribute : attributes.corners) {
    if (attribute.kind == CornerAttribute::Kind::skin) continue;
    const Steepness steepness(input, attribute);
    parallel_for(input.triangles.size(), [&](std::size_t t) {
      const double reach = options.simplify / steepness(t);
      options.reach[t] = std::min(options.reach[t], std::isnan(reach) ? 0 : reach);
    });
  }
}

}  // namespace meshrepair
