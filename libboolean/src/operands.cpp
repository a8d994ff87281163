// SPDX-License-Identifier: MIT
#include "operands.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include <base/error.h>
#include <bsp/common_grid.h>
#include <check/mesh_distance.h>
#include <mesh/append_soup.h>
#include <repair/join_gaps.h>
#include <repair/valid_solid.h>

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
          << " is too small next to the others: the common grid has 2^26 steps of " << grid.unit
          << "; remove distant parts from the others";
  throw InputError(message.str());
}

Grid grid_of(std::span<const TriangleSoup> solids) {
  if (solids.empty()) throw InputError("there is no solid to begin with");
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

JoinedSolids join_solids(std::span<const TriangleSoup> solids, const BooleanOptions& options,
                         BooleanReport& report) {
  const Grid grid = grid_of(solids);
  report.operands.resize(solids.size());
  std::vector<CleanSoup> soups;
  std::vector<std::size_t> given;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    soups.push_back(clean_operand(solids[i], i, grid, options, report));
    given.push_back(solids[i].triangles.size());
  }
  return {std::move(soups), given};
}

namespace {

// The triangles of an operand, from some number on, with the points that they have.
JoinedSoup triangles_of(const JoinedSoup& all, std::size_t first, std::size_t last) {
  constexpr std::uint32_t kUnused = ~std::uint32_t{0};
  std::vector<std::uint32_t> number(all.soup.points.size(), kUnused);
  JoinedSoup part;
  for (std::size_t t = first; t < last; ++t) {
    part.source.push_back(all.source[t]);
    part.soup.triangles.push_back(all.soup.triangles[t]);
    for (std::uint32_t& p : part.soup.triangles.back()) {
      if (number[p] == kUnused) {
        number[p] = static_cast<std::uint32_t>(part.soup.points.size());
        part.soup.points.push_back(all.soup.points[p]);
      }
      p = number[p];
    }
  }
  return part;
}

Surface as_solid(const TriangleSoup& soup, const BooleanOptions& options) {
  RepairOptions repairing;
  repairing.simplify = 0;
  CancelOnly quiet(options.repair.progress);
  repairing.progress = &quiet;
  if (auto kept = valid_solid(soup, repairing.certify, &quiet)) return std::move(*kept);
  RepairReport report;
  return repair(soup, repairing, report);
}

}  // namespace

std::optional<JoinedOperands> join_operands(std::span<const TriangleSoup> solids,
                                            const BooleanOptions& options, RepairReport& report) {
  JoinGapsOptions joining = options.repair.join_gaps;
  joining.progress = options.repair.progress;
  if (joining.mode == JoinGapsMode::none && joining.touching == 0) return std::nullopt;
  StageMeter meter(report.stages, joining.progress);
  meter.begin("join_gaps");
  TriangleSoup all;
  for (const TriangleSoup& solid : solids) append_soup(all, solid);
  const std::optional<JoinedSoup> joined = join_gaps(all, joining, report.join_gaps);
  if (!joined) return std::nullopt;
  JoinedOperands operands;
  std::size_t first = 0, given = 0;
  for (const TriangleSoup& solid : solids) {
    given += solid.triangles.size();
    const auto after = std::lower_bound(joined->source.begin(), joined->source.end(), given);
    const auto last = static_cast<std::size_t>(after - joined->source.begin());
    Surface surface;
    JoinedSoup part = triangles_of(*joined, first, last);
    drop_facing_copies(all, part);
    if (first < last) surface = as_solid(part.soup, options);
    for (const std::uint32_t t : surface.source) {
      operands.source.push_back(t == Surface::kNoSource ? t : part.source[t]);
    }
    operands.solids.push_back(std::move(surface.mesh));
    first = last;
  }
  return operands;
}

std::uint32_t given_source(const JoinedOperands& joined, std::uint32_t source) {
  return source == Surface::kNoSource ? source : joined.source[source];
}

}  // namespace meshrepair::internal
