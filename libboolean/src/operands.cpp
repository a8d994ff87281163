#include "operands.h"

#include <cmath>
#include <sstream>
#include <vector>

#include <base/error.h>
#include <bsp/common_grid.h>
#include <check/mesh_distance.h>

namespace meshrepair::internal {
namespace {

double volume_on_grid(const TriangleSoup& solid, const Grid& grid) {
  TriangleSoup rounded;
  rounded.triangles = solid.triangles;
  rounded.points.reserve(solid.points.size());
  for (const Vec3d& p : solid.points) rounded.points.push_back(as_vector(grid.to_grid(p)));
  return signed_volume(rounded) * grid.unit * grid.unit * grid.unit;
}

// Of the solid's diagonal that a step of the grid may be: corners move by up to that. And of its
// volume, from the rounding of points.
constexpr double kLongestStep = 0.02;
constexpr double kMostChange = 0.01;

}  // namespace

void throw_too_small(std::size_t operand, const Grid& grid) {
  std::ostringstream message;
  message << "solid " << operand + 1
          << " is too small beside the others: the grid over all has 2^26 steps, of " << grid.unit
          << " each; leave out of the others what is far from it";
  throw InputError(message.str());
}

Grid grid_of(std::span<const TriangleSoup> solids, BooleanReport& report) {
  if (solids.empty()) throw InputError("there is no solid to begin with");
  report.operands.resize(solids.size());
  std::vector<const TriangleSoup*> all;
  all.reserve(solids.size());
  for (const TriangleSoup& solid : solids) all.push_back(&solid);
  return make_grid(all);
}

CleanSoup clean_operand(const TriangleSoup& solid, std::size_t number, const Grid& grid,
                        const BooleanOptions& options, BooleanReport& report) {
  OperandReport& operand = report.operands[number];
  operand.volume = signed_volume(solid);
  CleanSoup clean;
  clean.grid = grid;
  if (solid.triangles.empty()) return clean;
  clean = clean_soup(solid, grid, operand.clean, options.repair.progress);
  if (clean.triangles.empty()) throw_too_small(number, grid);
  const double change = volume_on_grid(solid, grid) - operand.volume;
  if (std::abs(change) > kMostChange * operand.volume ||
      grid.unit > kLongestStep * bounding_diagonal(solid)) {
    throw_too_small(number, grid);
  }
  return clean;
}

}  // namespace meshrepair::internal
