// SPDX-License-Identifier: MIT
// From a point cloud to the boundary of a solid: the local triangulation and its repair. Where the
// points enclose nothing as they are, smoother ones are tried, and a base below them.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <mesh/point_cloud.h>
#include <points/point_soup.h>
#include <points/scan_base.h>
#include <repair/repair.h>

namespace meshrepair {

// What may differ from the options where these lead to no solid.
struct PointAdviceOptions {
  bool project = true;     // PointSoupOptions::project
  bool neighbours = true;  // PointSoupOptions::neighbours
  bool base = true;        // RepairPointsOptions::base, for what looks like a terrain
};

struct RepairPointsOptions {
  PointSoupOptions soup;
  bool base = false;  // walls and a floor below an open scan, as scan_base says
  ScanBaseOptions scan_base;
  PointAdviceOptions advice;
  // Its `opacity` and `examine` are set, and so is for a base how large holes may be.
  RepairOptions repair;
};

enum class PointTryEnd {
  noisy,   // not repaired, as smoothing left too much noise
  open,    // encloses nothing, or too little
  faulty,  // encloses something, but is not certified
  solid,
};

// One set of options, and what came of it.
struct PointTry {
  int project = 0;
  std::size_t neighbours = 0;
  bool base = false;
  bool walls = false;    // of open sheets, as RepairOptions::thicken says
  double agreement = 0;  // PointSoupReport::agreement()
  PointTryEnd end = PointTryEnd::open;
};

// Filled as far as the work came, also when it ended with an exception.
struct RepairPointsReport {
  std::optional<PointSoupReport> soup;      // of the last try that was repaired
  std::optional<ScanBaseReport> scan_base;  // the same, if it stood on one
  std::vector<PointTry> tries;              // the first one is what the options say
  std::size_t dropped_solids = 0;           // too small for the points to tell
  std::size_t points_in_result = 0;         // of those left in `soup`
  std::size_t joined_columns = 0;           // points left out: above others in single precision
};

struct PointSolid {
  TriangleSoup soup;  // that was repaired
  Surface surface;
};

// Points whose triangles agree less than this are noisy. Between points without noise, all three
// corners want nearly all triangles; with noise of a quarter of the spacing, half of them.
inline constexpr double kNoisyAgreement = 0.5;

// The first try that encloses something is taken if it is what the options say, or certified:
//
// - what the options say;
// - where the points are noisy, points that are smoothed more and more, until they agree;
// - where these, or points without noise, are a terrain (points/terrain.h), the same on a base;
// - with an automatic RepairOptions::thicken, walls around the triangles of the same points.
//
// On a base that was asked for, of points that single precision puts above each other, where that
// is what is written, the first alone counts.
//
// A scan of one side encloses too little: most of its triangles would be no wall of the solid, or
// too much of the surface would be made up. Solids of fewer triangles than soup.fewest_triangles
// are left out. `repair` is the report of the last try that was repaired; its stages begin with
// those that it had, and stages of tries before are one, "tries". Throws UsageError,
// NoSolidError when no try encloses enough, LimitError, OutputError, Cancelled.
[[nodiscard]] PointSolid repair_points(const PointCloud& cloud, const RepairPointsOptions& options,
                                       RepairPointsReport& report, RepairReport& repair);

}  // namespace meshrepair
