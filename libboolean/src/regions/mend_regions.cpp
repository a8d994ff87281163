// SPDX-License-Identifier: MIT
// Each kind of edit is tried at all faults, as long as one is of use, and then farther away: parts
// that are flat go, points and edges come together, and points move by some units of the numbers.
#include "mend_regions.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <check/self_intersections.h>
#include <exact/double_predicates.h>
#include <extract/surface.h>
#include <repair/internal/mend_faults.h>

#include "merge_points.h"
#include "region_edges.h"

namespace meshrepair::internal {
namespace {

// More faults than these are not of single places.
constexpr std::size_t kMostFaultyPairs = 10'000;

// How far points move at first and at last to become one with another, in units, and how many times
// as far from one try to the next.
constexpr double kLeastReach = 2, kMostReach = 1024, kReachFactor = 8;

// Triangles that meet, edges that are turned, and parts inside out. A triangle without area is a
// pair with itself, and so is one at such an edge.
struct Faults {
  std::size_t meeting = 0, turned_edges = 0, turned_parts = 0, count = 0;
  FaultyPairs pairs;
  SelfIntersections found;
};

Faults find_faults(const RegionComplex& complex, ProgressObserver* progress) {
  const TriangleSoup& mesh = complex.mesh;
  SelfIntersectionOptions options;
  options.weld = false;
  options.most_pairs = kMostFaultyPairs + 1;
  options.progress = progress;
  Faults faults;
  faults.found = self_intersections(mesh, options);
  faults.count = faults.found.count + faults.found.degenerate + faults.found.not_finite;
  faults.pairs = faults.found.pairs;
  for (std::uint32_t t = 0; faults.found.degenerate > 0 && t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (projection_axis(mesh.points[a], mesh.points[b], mesh.points[c]) < 0) {
      faults.pairs.push_back({t, t});
    }
  }
  const auto turned = triangles_at_turned_edges(mesh, complex.parts_of);
  for (const std::uint32_t t : turned) faults.pairs.push_back({t, t});
  faults.turned_edges = turned.size();
  const auto sizes = sizes_of_parts(complex);
  faults.turned_parts = static_cast<std::size_t>(std::count_if(
      sizes.begin() + 1, sizes.end(), [](const PartSize& size) { return size.is_turned(); }));
  faults.meeting = faults.count;
  faults.count += faults.turned_edges + faults.turned_parts;
  return faults;
}

// One kind of edit, tried at all faults. Returns how many were made.
using Step = std::size_t (*)(RegionComplex&, const Faults&, const MendRegionsOptions&,
                             double within, double& distance);

// Parts at fault that are no thicker than rounding, and those inside out, go to a part beside them.
std::size_t drop_thin_parts(RegionComplex& complex, const Faults& faults,
                            const MendRegionsOptions& options, double, double& distance) {
  const double thin = kLeastReach * options.unit;
  const auto sizes = sizes_of_parts(complex);
  std::vector<char> goes(sizes.size(), 0);
  for (const auto& pair : faults.pairs) {
    for (const std::uint32_t t : pair) {
      for (const std::uint32_t part : complex.parts_of[t]) {
        goes[part] = 2 * sizes[part].volume <= thin * sizes[part].area ? 1 : 0;
      }
    }
  }
  for (std::size_t part = 0; part < sizes.size(); ++part) {
    if (sizes[part].is_turned()) goes[part] = 1;
  }
  goes[0] = 0;  // what is outside
  // Where most of their area is.
  std::map<std::array<std::uint32_t, 2>, double> areas;
  for (std::size_t t = 0; t < complex.parts_of.size(); ++t) {
    const auto& [front, behind] = complex.parts_of[t];
    const auto& [p, q, r] = complex.mesh.triangles[t];
    const std::vector<Vec3d>& at = complex.mesh.points;
    const double area = (at[q] - at[p]).cross(at[r] - at[p]).norm();
    if (goes[front] != 0 && goes[behind] == 0) areas[{front, behind}] += area;
    if (goes[behind] != 0 && goes[front] == 0) areas[{behind, front}] += area;
  }
  std::vector<std::uint32_t> becomes(sizes.size());
  std::iota(becomes.begin(), becomes.end(), 0u);
  std::vector<double> most(sizes.size(), -1);
  for (const auto& [parts, area] : areas) {
    if (area <= most[parts[0]]) continue;
    most[parts[0]] = area;
    becomes[parts[0]] = parts[1];
  }
  distance = thin;
  std::size_t gone = 0;
  for (std::uint32_t part = 0; part < becomes.size(); ++part) gone += becomes[part] != part ? 1 : 0;
  if (gone > 0) complex = compacted(complex, becomes);
  return gone;
}

std::size_t merge_near_points(RegionComplex& complex, const Faults& faults,
                              const MendRegionsOptions& options, double within, double& distance) {
  return merge_points(complex, faults.pairs, {within, options.precision, options.progress},
                      distance);
}

std::size_t move_points(RegionComplex& complex, const Faults& faults,
                        const MendRegionsOptions& options, double within, double& distance) {
  Surface surface;
  surface.mesh = complex.mesh;
  surface.input_point.assign(complex.mesh.points.size(), 0);
  for (std::uint32_t t = 0; t < complex.mesh.triangles.size(); ++t) surface.source.push_back(t);
  MendOptions mending;
  mending.step = number_spacing(complex.mesh, options.precision);
  mending.within = within;
  mending.rounded = [&](const Vec3d& p) { return rounded_to(p, options.precision); };
  mending.progress = options.progress;
  const std::size_t edits = mend_faults(surface, faults.found, mending);
  if (edits == 0) return 0;
  distance = std::max(within, kMostMendShift * mending.step);
  RegionComplex result;
  result.mesh = std::move(surface.mesh);
  result.region_of_part = complex.region_of_part;
  for (const std::uint32_t t : surface.source) {
    result.parts_of.push_back(complex.parts_of[t]);
    result.source.push_back(complex.source[t]);
  }
  complex = std::move(result);
  return edits;
}

// Makes the step if that leaves fewer faults.
bool is_of_use(Step step, double within, const MendRegionsOptions& options, RegionComplex& complex,
               Faults& faults, MendRegionsReport& report) {
  RegionComplex mended = complex;
  double distance = 0;
  const std::size_t edits = step(mended, faults, options, within, distance);
  if (edits == 0) return false;
  Faults left = find_faults(mended, options.progress);
  if (left.count >= faults.count) return false;
  report.edits += edits;
  report.distance = std::max(report.distance, distance);
  faults = std::move(left);
  complex = std::move(mended);
  return true;
}

}  // namespace

void mend_regions(RegionComplex& complex, const MendRegionsOptions& options,
                  MendRegionsReport& report) {
  report = {};
  if (complex.mesh.triangles.empty()) return;
  Faults faults = find_faults(complex, options.progress);
  report = {faults.meeting, faults.meeting};
  for (double reach = kLeastReach; reach <= kMostReach; reach *= kReachFactor) {
    const double within = reach * options.unit;
    bool goes_on = true;
    while (goes_on && faults.count > 0 && faults.pairs.size() <= kMostFaultyPairs) {
      goes_on = false;
      for (const Step step : {&drop_thin_parts, &merge_near_points, &move_points}) {
        if (faults.count == 0) break;
        if (is_of_use(step, within, options, complex, faults, report)) goes_on = true;
      }
    }
  }
  report.pairs = faults.meeting;
  report.turned_edges = faults.turned_edges;
  report.turned_parts = faults.turned_parts;
}

}  // namespace meshrepair::internal
