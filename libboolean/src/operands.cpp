#include "operands.h"

#include <sstream>
#include <vector>

#include <base/error.h>
#include <bsp/common_grid.h>

namespace meshrepair::internal {
namespace {

double volume_on_grid(const TriangleSoup& solid, const Grid& grid) {
  TriangleSoup rounded;
  rounded.triangles = solid.triangles;
  rounded.points.reserve(solid.points.size());
  for (const Vec3d& p : solid.points) rounded.points.push_back(as_vector(grid.to_grid(p)));
  return signed_volume(rounded) * grid.unit * grid.unit * grid.unit;
}

}  // namespace

void throw_too_small(std::size_t operand, const Grid& grid) {
  std::ostringstream message;
  message << "solid " << operand + 1
          << " is nothing beside the others: on the grid of 2^26 steps over all, of " << grid.unit
          << " each, it has no volume";
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
  operand.volume_on_grid = volume_on_grid(solid, grid);
  return clean;
}

}  // namespace meshrepair::internal
