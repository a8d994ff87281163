// SPDX-License-Identifier: MIT
#include "sift_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <utility>

#include <base/internal/hash_index.h>
#include <mesh/weld_points.h>

#include "point_blocks.h"
#include "point_index.h"

namespace meshrepair {

namespace {

// Fewer are found as fast without knowing how far away they are.
constexpr std::size_t kMany = 32;

// More than rounding adds to a distance.
constexpr double kRounding = 1 + 1e-9;

// Looks up one point after the other. As many as are near one are near the next one, too, if
// the way to it is added.
class NearestFinder {
 public:
  NearestFinder(const PointIndex& index, std::size_t count) : index_(index), found_(count) {}

  std::span<const Neighbour> find(const Vec3d& at) {
    if (found_.size() < kMany) {
      index_.nearest(at, found_);
      return found_;
    }
    const double within = kRounding * (farthest_ + (at - last_).norm());
    if (farthest_ > 0) index_.nearest(at, within * within, scratch_, found_);
    if (!(farthest_ > 0)) index_.nearest(at, found_);
    farthest_ = std::sqrt(found_.back().distance);
    last_ = at;
    return found_;
  }

 private:
  const PointIndex& index_;
  std::vector<Neighbour> found_, scratch_;
  Vec3d last_ = Vec3d::Zero();
  double farthest_ = 0;  // from the last point; 0: there was none
};

}  // namespace

Neighbourhoods find_neighbourhoods(const PointIndex& index, const std::vector<Vec3d>& points,
                                   std::size_t count, ProgressObserver* progress) {
  Neighbourhoods result;
  if (points.empty()) return result;
  result.per_point = std::min(count, points.size() - 1);
  result.points.resize(points.size() * result.per_point);
  for_blocks(points.size(), progress, [&](std::size_t, std::size_t first, std::size_t last) {
    NearestFinder finder(index, result.per_point + 1);
    for (std::size_t i = first; i < last; ++i) {
      const std::uint32_t p = index.order()[i];
      const std::span<const Neighbour> found = finder.find(points[p]);
      // Where points coincide, the point itself need not be among those that were found.
      std::uint32_t* out = result.points.data() + std::size_t{p} * result.per_point;
      std::uint32_t* const end = out + result.per_point;
      for (const Neighbour& neighbour : found) {
        if (neighbour.point != p && out != end) *out++ = neighbour.point;
      }
    }
  });
  return result;
}

namespace {

// So many neighbours tell how dense the points are: fewer are left to chance, more look too far.
constexpr std::size_t kDensityNeighbours = 12;

// Neighbours whose spacings an outlier is held against.
constexpr std::size_t kWitnesses = 6;

struct Extent {
  Vec3d low = Vec3d::Constant(std::numeric_limits<double>::infinity());
  Vec3d high = -low;
};

// Halved before they are subtracted: the difference may be beyond the range of doubles.
void set_frame(const PointCloud& cloud, SiftedCloud& sifted) {
  Extent box;
  for (const std::uint32_t p : sifted.original) {
    box.low = box.low.cwiseMin(cloud.points[p]);
    box.high = box.high.cwiseMax(cloud.points[p]);
  }
  sifted.centre = 0.5 * box.low + 0.5 * box.high;
  const double half = (0.5 * box.high - 0.5 * box.low).maxCoeff();
  sifted.scale = half > 0 ? half : 1;
}

// Finite points, each place once.
void take_distinct(const PointCloud& cloud, SiftedCloud& sifted, PointSoupReport& report) {
  std::vector<Vec3d> distinct;
  PointWelder welder(distinct, cloud.points.size());
  for (std::size_t p = 0; p < cloud.points.size(); ++p) {
    if (!cloud.points[p].allFinite()) {
      ++report.not_finite;
    } else if (const std::size_t before = distinct.size();
               welder.index_of(cloud.points[p]) == before) {
      sifted.original.push_back(static_cast<std::uint32_t>(p));
    } else {
      ++report.duplicates;
    }
  }
}

Vec3d unit_or_zero(const Vec3d& normal) {
  const double largest = normal.cwiseAbs().maxCoeff();
  if (!(largest > 0) || !std::isfinite(largest)) return Vec3d::Zero();
  return (normal / largest).normalized();
}

void scale_points(const PointCloud& cloud, const PointSoupOptions& options, SiftedCloud& sifted) {
  const bool with_normals = options.use_normals && !cloud.normals.empty();
  sifted.points.clear();
  sifted.normals.clear();
  for (const std::uint32_t p : sifted.original) {
    sifted.points.emplace_back((cloud.points[p] - sifted.centre) / sifted.scale);
    if (with_normals) sifted.normals.push_back(unit_or_zero(cloud.normals[p]));
  }
}

// The side of the square that each of the nearest points would have to itself if they were spread
// evenly over the disc that they lie in.
void measure_spacing(SiftedCloud& sifted) {
  const std::size_t count = std::min(kDensityNeighbours, sifted.around.per_point);
  sifted.spacing.assign(sifted.points.size(), 0);
  if (count == 0) return;
  const double share = std::sqrt(std::numbers::pi / static_cast<double>(count));
  for_blocks(sifted.points.size(), nullptr, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p) {
      const Vec3d& farthest = sifted.points[sifted.around.of(p)[count - 1]];
      sifted.spacing[p] = share * (farthest - sifted.points[p]).norm();
    }
  });
}

double median_spacing_around(const SiftedCloud& sifted, std::size_t point) {
  std::array<double, kWitnesses> sorted{};
  const auto around = sifted.around.of(point);
  const std::size_t count = std::min(kWitnesses, around.size());
  for (std::size_t i = 0; i < count; ++i) {
    const double spacing = sifted.spacing[around[i]];
    std::size_t at = i;
    for (; at > 0 && sorted[at - 1] > spacing; --at) sorted[at] = sorted[at - 1];
    sorted[at] = spacing;
  }
  return sorted[count / 2];
}

// Of points too near to each other, the first stays. False if nothing was dropped.
bool drop_odd_points(SiftedCloud& sifted, const PointSoupOptions& options,
                     PointSoupReport& report) {
  enum class Fate : char { stays, duplicate, outlier };
  std::vector<Fate> fates(sifted.points.size(), Fate::stays);
  for (std::size_t p = 0; p < fates.size(); ++p) {
    const auto around = sifted.around.of(p);
    if (around.empty()) continue;
    const double spacing = sifted.spacing[p];
    const double nearest = (sifted.points[around[0]] - sifted.points[p]).norm();
    if (nearest < options.duplicate * spacing && around[0] < p) {
      fates[p] = Fate::duplicate;
    } else if (options.outlier > 0 &&
               spacing > options.outlier * median_spacing_around(sifted, p)) {
      fates[p] = Fate::outlier;
    }
  }
  std::size_t kept = 0;
  for (std::size_t p = 0; p < fates.size(); ++p) {
    report.duplicates += fates[p] == Fate::duplicate;
    report.outliers += fates[p] == Fate::outlier;
    if (fates[p] == Fate::stays) sifted.original[kept++] = sifted.original[p];
  }
  if (kept == fates.size()) return false;
  sifted.original.resize(kept);
  return true;
}

void report_spacing(const SiftedCloud& sifted, PointSoupReport& report) {
  report.points = sifted.points.size();
  if (sifted.points.empty()) return;
  std::vector<double> spacing = sifted.spacing;
  const auto middle = spacing.begin() + static_cast<std::ptrdiff_t>(spacing.size() / 2);
  std::nth_element(spacing.begin(), middle, spacing.end());
  const auto [least, most] = std::minmax_element(spacing.begin(), spacing.end());
  report.spacing = *middle * sifted.scale;
  report.smallest_spacing = *least * sifted.scale;
  report.largest_spacing = *most * sifted.scale;
}

}  // namespace

void look_around(SiftedCloud& sifted, const PointSoupOptions& options) {
  sifted.index.reset();
  sifted.index = std::make_unique<const PointIndex>(sifted.points);
  const std::size_t count = std::max(options.neighbours, kDensityNeighbours);
  CancelOnly cancel(options.progress);
  sifted.around = find_neighbourhoods(*sifted.index, sifted.points, count, &cancel);
  measure_spacing(sifted);
}

SiftedCloud sift_points(const PointCloud& cloud, const PointSoupOptions& options,
                        PointSoupReport& report) {
  report = {};
  report.points_in = cloud.points.size();
  SiftedCloud sifted;
  take_distinct(cloud, sifted, report);
  set_frame(cloud, sifted);
  scale_points(cloud, options, sifted);
  look_around(sifted, options);
  if (drop_odd_points(sifted, options, report)) {
    set_frame(cloud, sifted);
    scale_points(cloud, options, sifted);
    look_around(sifted, options);
  }
  report_spacing(sifted, report);
  return sifted;
}

}  // namespace meshrepair
