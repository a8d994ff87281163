// SPDX-License-Identifier: MIT
// Inward, the cavities of the solid are what is left of it. Outward, those of the space around it
// are, in a box that is so large that its own walls are farther away: what is between them and the
// solid is the result.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include <base/error.h>
#include <base/stage_meter.h>
#include <check/mesh_distance.h>
#include <hollow/offset.h>
#include <mesh/append_soup.h>
#include <mesh/mesh_parts.h>
#include <mesh/precision.h>
#include <mesh/topology.h>

#include "common/replace_result.h"
#include "common/soup_box.h"
#include "walls/wall_maker.h"

namespace meshrepair {
namespace {

using internal::Cavities;
using internal::WallMaker;

// From the solid to the box, in distances: walls of the box are 1.5 from those of the solid.
constexpr double kRoom = 2.5;
constexpr double kMostOfSize = 1000;  // of the solid's diagonal: the farthest offset

TriangleSoup turned(TriangleSoup soup) {
  for (auto& triangle : soup.triangles) std::swap(triangle[1], triangle[2]);
  return soup;
}

TriangleSoup box_around(const TriangleSoup& solid, double room) {
  Box around = internal::box_of(solid);
  around.widen(room);
  TriangleSoup box;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Vec3d point;
    for (unsigned k = 0; k < 3; ++k) {
      point[k] = (corner >> k & 1U) != 0 ? around.high[k] : around.low[k];
    }
    box.points.push_back(point);
  }
  box.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                   {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return box;
}

TriangleSoup space_around(const TriangleSoup& solid, double distance) {
  TriangleSoup space = box_around(solid, kRoom * distance);
  append_soup(space, turned(solid));
  return space;
}

class Offsetter {
 public:
  Offsetter(const Surface& solid, double distance, const RepairOptions& options, OffsetReport& made,
            RepairReport& report)
      : outward_(distance > 0),
        distance_(std::abs(distance)),
        options_(options),
        made_(made),
        report_(report),
        space_(outward_ ? space_around(solid.mesh, distance_) : solid.mesh),
        maker_(space_, distance_, options.certify.precision, "--offset", options.progress),
        meter_(report.stages, options.progress) {}

  Surface run() {
    meter_.begin("offset");
    Cavities found = maker_.find();
    made_.cells = found.cells;
    made_.unproven = found.unproven;
    meter_.begin("coarsen");
    maker_.take_away_triangles(found);
    TriangleSoup walls = walls_of(found);
    if (walls.triangles.empty()) {
      throw NoSolidError("nothing is left of the solid at this distance below its surface");
    }
    meter_.begin("certify");
    Surface result = certified(walls);
    meter_.begin("walls");
    measure(result);
    return result;
  }

 private:
  // What is not deeper than the error may go: its walls are as good elsewhere.
  [[nodiscard]] TriangleSoup walls_of(const Cavities& found) const {
    const MeshParts parts = find_parts(found.walls);
    std::vector<char> stays(parts.count, 1);
    for (std::size_t t = 0; t < found.cavity.size(); ++t) {
      const double depth = found.deepest[found.cavity[t]].distance;
      if (depth <= (1 + kHollowError) * distance_) stays[parts.of_triangle[t]] = 0;
    }
    if (outward_) stays[part_of_box(found.walls, parts)] = 0;
    TriangleSoup walls;
    walls.points = found.walls.points;
    for (std::size_t t = 0; t < found.cavity.size(); ++t) {
      if (stays[parts.of_triangle[t]] != 0) walls.triangles.push_back(found.walls.triangles[t]);
    }
    return outward_ ? turned(std::move(walls)) : walls;
  }

  // It is around all others.
  static std::uint32_t part_of_box(const TriangleSoup& walls, const MeshParts& parts) {
    std::size_t first = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < walls.triangles.size(); ++t) {
      const double x = walls.points[walls.triangles[t][0]].x();
      if (x >= least) continue;
      least = x;
      first = t;
    }
    return parts.of_triangle[first];
  }

  Surface certified(const TriangleSoup& walls) {
    CancelOnly quiet(options_.progress);
    RepairOptions again;
    again.certify = options_.certify;
    again.extract.touching = options_.extract.touching;
    again.progress = &quiet;
    RepairReport told;
    Surface result = repair(walls, again, told);
    std::fill(result.source.begin(), result.source.end(), Surface::kNoSource);
    internal::replace_result(report_, told);
    report_.triangles = {};  // all have moved
    return result;
  }

  // On the coordinates of the result.
  void measure(const Surface& result) {
    std::vector<std::uint32_t> all(result.mesh.triangles.size());
    std::iota(all.begin(), all.end(), 0u);
    const WallMaker::Bounds bounds = maker_.measure(result.mesh, all);
    made_.least = bounds.least;
    made_.most = bounds.most;
    made_.unproven += bounds.beside;
  }

  const bool outward_;
  const double distance_;
  const RepairOptions& options_;
  OffsetReport& made_;
  RepairReport& report_;
  const TriangleSoup space_;  // whose cavities are looked for
  const WallMaker maker_;
  StageMeter meter_;
};

void check_distance(const TriangleSoup& solid, double distance, Precision precision) {
  internal::check_length(solid, distance, "--offset");
  if (distance > kMostOfSize * bounding_diagonal(solid)) {
    throw ValueError("--offset: more than a thousand times the size of the body is too large");
  }
  if (internal::number_spacing(solid, precision) <= kHollowError * distance) return;
  throw ValueError(
      "--offset: rounding coordinates of this size moves them by more than the distance allows; "
      "--origin auto, or a format of double precision, may do");
}

}  // namespace

Surface offset(const Surface& solid, double distance, const RepairOptions& options,
               OffsetReport& made, RepairReport& report) {
  if (distance == 0 || !std::isfinite(distance)) {
    throw UsageError("--offset: a distance above or below 0");
  }
  check_distance(solid.mesh, std::abs(distance), options.certify.precision);
  made = {};
  made.distance = distance;
  made.volume_before = signed_volume(solid.mesh);
  return Offsetter(solid, distance, options, made, report).run();
}

}  // namespace meshrepair
