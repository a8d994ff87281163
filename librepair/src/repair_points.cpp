// SPDX-License-Identifier: MIT
// Points with much noise want triangles that pass each other, so the sheet between them has holes
// all over, and encloses nothing. Smoothing needs neighbours enough to even out the noise, and few
// enough to leave the shape as it is: they are doubled until the points agree. That is seen before
// anything is repaired. If smooth points enclose nothing either, more smoothing does not help.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <base/error.h>
#include <base/stage_meter.h>
#include <mesh/precision.h>
#include <points/terrain.h>
#include <repair/keep_parts.h>
#include <repair/repair_on_base.h>
#include <repair/repair_points.h>

#include "fewer/fewer_triangles.h"

namespace meshrepair {
namespace {

// Points are smooth where so much of their triangles is wanted by all three corners. Below, what is
// left of the noise makes handles and bubbles, or joins the two sides of a thin plate.
constexpr double kSmoothAgreement = 0.8;

constexpr int kProject = 3;
constexpr std::array<std::size_t, 4> kNeighbours = {30, 60, 120, 240};
// Points move onto surfaces through twice their neighbours. If these are more than an eighth of all
// points, their surface is not flat.
constexpr std::size_t kFewestNeighbourhoods = 16;

// Of the triangles of a scan that is closed but for holes, most are in the result, and most of the
// result is of them. Scans of one side come to less than a third or more than half.
constexpr double kFewestKept = 0.5;
constexpr double kMostMadeUpOfScan = 0.4;
// Smoothing pulls rims together and closes holes, so of the result of a try that nobody asked for
// less may be made up: a half-sphere comes to a third.
constexpr double kMostMadeUpByAdvice = 0.25;

std::string percent_text(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

void require_enclosure(const RepairReport& repair, double most_made_up) {
  const auto kept = static_cast<double>(repair.triangles.untouched + repair.triangles.cut);
  const double share = kept / static_cast<double>(repair.clean.triangles_in);
  if (share < kFewestKept) {
    throw NoSolidError(
        "the points enclose little: " + percent_text(1 - share) +
        " of the triangles between them are no wall of anything, as in a scan of one side");
  }
  const double made_up = repair.closing_area / repair.output_area;
  if (made_up > most_made_up) {
    throw NoSolidError("the points leave too much open: " + percent_text(made_up) +
                       " of the surface would be made up");
  }
}

bool is_certified(const RepairReport& repair) {
  return repair.output.closed() && repair.output.manifold() && repair.output.oriented() &&
         repair.certify.passed();
}

// Makes one of all stages from `first` on.
void join_stages(std::vector<StageReport>& stages, std::size_t first) {
  StageReport joined{"tries", 0, 0, 0};
  for (std::size_t i = first; i < stages.size(); ++i) {
    joined.seconds += stages[i].seconds;
    joined.cpu_seconds += stages[i].cpu_seconds;
    joined.peak_bytes = std::max(joined.peak_bytes, stages[i].peak_bytes);
  }
  stages.resize(first);
  stages.push_back(std::move(joined));
}

bool comes_first(const Vec3d& a, const Vec3d& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

// Of the points of the result those that are given, if only as single precision has them.
std::size_t count_given(const std::vector<Vec3d>& given, const Surface& surface,
                        Precision precision) {
  const std::vector<char>& is_given = surface.input_point;
  if (precision == Precision::float64) {
    return static_cast<std::size_t>(std::count(is_given.begin(), is_given.end(), 1));
  }
  std::vector<Vec3d> rounded;
  for (const Vec3d& point : given) {
    if (point.allFinite()) rounded.push_back(rounded_to_float32(point));
  }
  std::sort(rounded.begin(), rounded.end(), &comes_first);
  const auto& points = surface.mesh.points;
  return static_cast<std::size_t>(std::count_if(points.begin(), points.end(), [&](const Vec3d& p) {
    return std::binary_search(rounded.begin(), rounded.end(), p, &comes_first);
  }));
}

class PointRepair {
 public:
  PointRepair(const PointCloud& cloud, const RepairPointsOptions& options,
              RepairPointsReport& report, RepairReport& repair)
      : cloud_(cloud),
        options_(options),
        report_(report),
        repair_(repair),
        stages_before_(repair.stages.size()) {}

  PointSolid run() {
    PointSoup soup = triangulate(options_.soup);
    const bool noisy = report_.soup->agreement() < kNoisyAgreement;
    if (auto solid = enclose(soup, asked())) return std::move(*solid);
    if (noisy && !smooth(soup)) throw NoSolidError(why_);
    if (noisy) {
      if (auto solid = enclose(soup, asked())) return std::move(*solid);
    }
    if (auto solid = stand_on_base(soup)) return std::move(*solid);
    if (auto solid = stand_as_wall(soup)) return std::move(*solid);
    throw NoSolidError(why_);
  }

 private:
  // What is done about open rims before holes are closed.
  enum class Closing { none, base, walls };

  void begin_try(const PointSoupOptions& soup, Closing closing, double agreement, PointTryEnd end) {
    report_.tries.push_back({soup.project, soup.neighbours, closing == Closing::base,
                             closing == Closing::walls, agreement, end});
  }

  PointSoup triangulate(const PointSoupOptions& options) {
    PointSoupReport found;
    PointSoupOptions observed = options;
    observed.progress = options_.repair.progress;
    StageMeter meter(repair_.stages, options_.repair.progress);
    meter.begin("points");
    try {
      PointSoup soup = make_point_soup(cloud_, observed, found);
      used_ = options;
      report_.soup = found;
      return soup;
    } catch (...) {
      if (!report_.soup) report_.soup = found;
      throw;
    }
  }

  [[nodiscard]] Closing asked() const { return options_.base ? Closing::base : Closing::none; }

  // Points that agree, into `soup`, which is left as it is where there are none.
  bool smooth(PointSoup& soup) {
    const PointSoupReport before = *report_.soup;
    for (const PointSoupOptions& options : smoother_options()) {
      try {
        PointSoup smoothed = triangulate(options);
        if (report_.soup->agreement() >= kSmoothAgreement) {
          soup = std::move(smoothed);
          return true;
        }
        begin_try(options, asked(), report_.soup->agreement(), PointTryEnd::noisy);
      } catch (const NoSolidError&) {
        begin_try(options, asked(), 0, PointTryEnd::noisy);
      }
    }
    report_.soup = before;
    return false;
  }

  [[nodiscard]] std::vector<PointSoupOptions> smoother_options() const {
    const PointAdviceOptions& advice = options_.advice;
    PointSoupOptions smoother = options_.soup;
    if (advice.project) smoother.project = std::max(smoother.project, kProject);
    if (smoother.project == 0) return {};
    if (!advice.neighbours) {
      return advice.project ? std::vector{smoother} : std::vector<PointSoupOptions>();
    }
    std::vector<PointSoupOptions> list;
    for (const std::size_t neighbours : kNeighbours) {
      if (neighbours * kFewestNeighbourhoods > cloud_.points.size()) break;
      smoother.neighbours = neighbours;
      list.push_back(smoother);
    }
    return list;
  }

  std::optional<PointSolid> stand_on_base(const PointSoup& soup) {
    if (!options_.advice.base || options_.base) return std::nullopt;
    const int axis = options_.scan_base.axis;
    if (!is_terrain(soup.soup, axis, report_.soup->farthest_move)) return std::nullopt;
    return enclose(soup, Closing::base);
  }

  // A scan of one side is no sheet, but who asks for walls wants one of it.
  std::optional<PointSolid> stand_as_wall(const PointSoup& soup) {
    if (!options_.repair.thicken.automatic || options_.base) return std::nullopt;
    return enclose(soup, Closing::walls);
  }

  // The next try, on triangles that are there; nothing, and why, if it is no solid.
  std::optional<PointSolid> enclose(const PointSoup& soup, Closing closing) {
    const bool first = report_.tries.empty();
    begin_try(used_, closing, report_.soup->agreement(), PointTryEnd::open);
    if (!first) {
      join_stages(repair_.stages, stages_before_);
      std::vector<StageReport> stages = std::move(repair_.stages);
      repair_ = {};
      repair_.stages = std::move(stages);
    }
    report_.scan_base.reset();
    try {
      PointSolid solid = repaired(soup, closing, first);
      const bool certified = is_certified(repair_);
      report_.tries.back().end = certified ? PointTryEnd::solid : PointTryEnd::faulty;
      if (first || certified) return solid;
      why_ = "the solid that the points enclose cannot be certified";
    } catch (const NoSolidError& error) {
      why_ = error.what();
    }
    return std::nullopt;
  }

  PointSolid repaired(const PointSoup& soup, Closing closing, bool first) {
    RepairOptions options = options_.repair;
    options.fewer = {};  // of the solid that is chosen
    options.thicken.automatic &= closing == Closing::walls;
    PointSolid solid;
    if (closing == Closing::base) {
      solid.soup = with_base(soup.soup, options_.scan_base, report_.scan_base.emplace());
      options.holes = holes_over_floor(options.holes);
    } else {
      solid.soup = soup.soup;
      options.opacity = soup.opacity();
      options.examine = [first](const RepairReport& repair) {
        require_enclosure(repair, first ? kMostMadeUpOfScan : kMostMadeUpByAdvice);
      };
    }
    solid.surface = repair(solid.soup, options, repair_);
    report_.dropped_solids =
        drop_small_parts(solid.surface, options_.soup.fewest_triangles, repair_);
    report_.points_in_result =
        count_given(solid.soup.points, solid.surface, options_.repair.certify.precision);
    return solid;
  }

  const PointCloud& cloud_;
  const RepairPointsOptions& options_;
  RepairPointsReport& report_;
  RepairReport& repair_;
  std::size_t stages_before_;
  PointSoupOptions used_;  // of the triangles that report_.soup is of
  std::string why_;        // the last try that was repaired is no solid
};

// Far from the origin the steps of single precision are wider than a terrain's points are apart.
// Rounded after they were triangulated, points beside each other would come to lie above each
// other, and triangles between them would cross all over.
using Column = std::array<double, 2>;

Column column_of(const Vec3d& p, int axis) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

template <class T>
void keep_points(const std::vector<std::uint32_t>& kept, std::vector<T>& of_points) {
  if (of_points.empty()) return;
  for (std::size_t i = 0; i < kept.size(); ++i) of_points[i] = of_points[kept[i]];
  of_points.resize(kept.size());
}

// The cloud as it can be written in single precision, if that brings points that are beside each
// other into one column along `axis`; of these it has the first alone. Nothing if it brings none.
std::optional<PointCloud> without_joined_columns(const PointCloud& cloud, int axis) {
  PointCloud rounded = cloud;
  std::vector<std::uint32_t> finite, kept;
  for (std::uint32_t i = 0; i < cloud.points.size(); ++i) {
    Vec3d& p = rounded.points[i];
    p = internal::rounded_to(p, Precision::float32);
    (p.allFinite() ? finite : kept).push_back(i);
  }
  const auto column = [&](std::uint32_t i) { return column_of(rounded.points[i], axis); };
  std::stable_sort(finite.begin(), finite.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return column(a) < column(b); });
  std::uint32_t first = 0;  // of its column
  for (std::size_t i = 0; i < finite.size(); ++i) {
    if (i == 0 || column(finite[i]) != column(first)) first = finite[i];
    const bool is_beside =
        column_of(cloud.points[finite[i]], axis) != column_of(cloud.points[first], axis);
    if (!is_beside) kept.push_back(finite[i]);
  }
  if (kept.size() == cloud.points.size()) return std::nullopt;
  std::sort(kept.begin(), kept.end());
  keep_points(kept, rounded.points);
  keep_points(kept, rounded.normals);
  keep_points(kept, rounded.colours);
  return rounded;
}

}  // namespace

namespace {

PointSolid repair_cloud(const PointCloud& cloud, const RepairPointsOptions& options,
                        RepairPointsReport& report, RepairReport& repair) {
  report = {};
  if (options.base && options.repair.certify.precision == Precision::float32) {
    const auto apart = without_joined_columns(cloud, options.scan_base.axis);
    if (apart) {
      report.joined_columns = cloud.points.size() - apart->points.size();
      return PointRepair(*apart, options, report, repair).run();
    }
  }
  return PointRepair(cloud, options, report, repair).run();
}

}  // namespace

PointSolid repair_points(const PointCloud& cloud, const RepairPointsOptions& options,
                         RepairPointsReport& report, RepairReport& repair) {
  PointSolid solid = repair_cloud(cloud, options, report, repair);
  if (options.repair.fewer.wanted()) {
    internal::take_triangles_away({}, solid.surface, options.repair, repair);
  }
  return solid;
}

}  // namespace meshrepair
