// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

#include <base/error.h>
#include <base/stage_meter.h>
#include <boolean/boolean.h>
#include <hollow/hollow.h>
#include <mesh/append_soup.h>
#include <mesh/mesh_parts.h>
#include <mesh/topology.h>

#include "common/replace_result.h"
#include "drains/place_drains.h"
#include "walls/wall_maker.h"

namespace meshrepair {
namespace {

using internal::Cavities;
using internal::CavityPlaces;
using internal::DrainPlacer;
using internal::Drill;
using internal::Place;
using internal::WallMaker;

constexpr double kLeastBall = 0.25;  // of the wall, that a cavity holds

class Hollower {
 public:
  Hollower(const Surface& solid, const HollowOptions& options, const RepairOptions& repair,
           HollowReport& hollowed, RepairReport& report)
      : solid_(solid),
        options_(options),
        repair_(repair),
        hollowed_(hollowed),
        report_(report),
        maker_(solid.mesh, options.wall, repair.certify.precision, "--hollow", repair.progress),
        meter_(report.stages, repair.progress) {}

  Surface run() {
    hollowed_ = {};
    hollowed_.wall = options_.wall;
    hollowed_.drain = options_.drain;
    hollowed_.volume_before = signed_volume(solid_.mesh);
    meter_.begin("cavities");
    find();
    note_places();
    meter_.begin("coarsen");
    maker_.take_away_triangles(found_);
    keep_large();
    if (hollowed_.cavities.empty()) return solid_;
    meter_.begin("drains");
    if (options_.drain > 0) place_drains();
    meter_.begin("subtract");
    Surface result = subtract();
    meter_.begin("walls");
    measure_walls(result);
    look_for_voids(result);
    name_sources(result);
    return result;
  }

 private:
  void find() {
    found_ = maker_.find();
    hollowed_.cells = found_.cells;
    hollowed_.finest = std::isfinite(found_.finest) ? found_.finest : 0;
    hollowed_.unproven = found_.unproven;
  }

  // Drains are looked for where tetrahedra are: later there are few corners.
  void note_places() {
    all_places_.resize(found_.deepest.size());
    for (std::size_t c = 0; c < found_.deepest.size(); ++c) {
      all_places_[c].deepest = found_.deepest[c];
    }
    if (options_.drain == 0) return;
    std::vector<char> is_noted(found_.walls.points.size(), 0);
    for (std::size_t t = 0; t < found_.cavity.size(); ++t) {
      CavityPlaces& places = all_places_[found_.cavity[t]];
      const auto& points = found_.walls.points;
      const auto& [a, b, c] = found_.walls.triangles[t];
      places.triangles.push_back({points[a], points[b], points[c]});
      for (const std::uint32_t point : {a, b, c}) {
        if (std::exchange(is_noted[point], 1) != 0) continue;
        places.corners.push_back(maker_.depth().place(points[point], places.deepest.nearest));
      }
    }
  }

  // Numbers cavities anew, and drops the triangles of those that stay full.
  void keep_large() {
    const std::size_t count = found_.deepest.size();
    std::vector<TriangleSoup> walls(count);
    for (std::size_t t = 0; t < found_.cavity.size(); ++t) {
      walls[found_.cavity[t]].triangles.push_back(found_.walls.triangles[t]);
    }
    const double least = std::max(options_.drain, kLeastBall * options_.wall);
    hollowed_.least_diameter = least;
    for (std::size_t c = 0; c < count; ++c) {
      walls[c] = without_others(walls[c].triangles);
      Cavity cavity;
      cavity.volume = signed_volume(walls[c]);
      cavity.diameter = 2 * (found_.deepest[c].distance - options_.wall);
      if (cavity.diameter < least) {
        ++hollowed_.left_full;
        hollowed_.left_full_volume += cavity.volume;
        continue;
      }
      hollowed_.cavities.push_back(cavity);
      places_.push_back(std::move(all_places_[c]));
      cavity_of_wall_.insert(cavity_of_wall_.end(), walls[c].triangles.size(),
                             static_cast<std::uint32_t>(hollowed_.cavities.size() - 1));
      append_soup(walls_, walls[c]);
    }
    found_ = {};
    all_places_.clear();
  }

  // With the points that these have.
  [[nodiscard]] TriangleSoup without_others(
      const std::vector<std::array<std::uint32_t, 3>>& triangles) const {
    TriangleSoup soup;
    std::vector<std::uint32_t> points;
    for (const auto& triangle : triangles)
      points.insert(points.end(), triangle.begin(), triangle.end());
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    for (const std::uint32_t point : points) soup.points.push_back(found_.walls.points[point]);
    for (auto triangle : triangles) {
      for (std::uint32_t& corner : triangle) {
        corner = static_cast<std::uint32_t>(std::lower_bound(points.begin(), points.end(), corner) -
                                            points.begin());
      }
      soup.triangles.push_back(triangle);
    }
    return soup;
  }

  void place_drains() {
    const DrainPlacer placer(solid_.mesh, maker_.depth(), options_);
    for (std::size_t i = 0; i < options_.drains_at.size(); ++i) add_drain_at(i, placer);
    for (std::size_t c = 0; c < places_.size(); ++c) {
      if (!hollowed_.cavities[c].drains.empty()) continue;
      for (const Drill& drill : placer.for_cavity(places_[c], drills_)) add(drill, c);
    }
  }

  // The drills before are those of the points before.
  void add_drain_at(std::size_t number, const DrainPlacer& placer) {
    const Vec3d& point = options_.drains_at[number];
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < places_.size(); ++c) {
      const double distance = placer.distance(point, places_[c]);
      if (distance >= least) continue;
      least = distance;
      nearest = c;
    }
    const auto drill = placer.from_point(point, places_[nearest], drills_);
    for (std::size_t other = 0; drill && other < drills_.size(); ++other) {
      if (placer.between(*drill, drills_[other]) > 0) continue;
      throw ValueError("--drain-at: the drains at " + name_of(other) + " and " + name_of(number) +
                       " overlap; places farther from each other or a smaller diameter may do");
    }
    if (!drill || drill->drain.beside <= 0) {
      throw ValueError("--drain-at: at " + name_of(number) +
                       ", no drain of this diameter leads from the surface into a cavity without "
                       "breaking out beside its mouth; another place or a smaller diameter may do");
    }
    add(*drill, nearest);
  }

  [[nodiscard]] std::string name_of(std::size_t point) const {
    if (point < options_.drain_names.size()) return options_.drain_names[point];
    return "point " + std::to_string(point + 1);
  }

  void add(const Drill& drill, std::size_t cavity) {
    double& least = hollowed_.beside_drains;
    least = drills_.empty() ? drill.drain.beside : std::min(least, drill.drain.beside);
    hollowed_.cavities[cavity].drains.push_back(drill.drain);
    drills_.push_back(drill);
  }

  Surface subtract() {
    std::vector<TriangleSoup> solids = {solid_.mesh, walls_};
    for (const Drill& drill : drills_) solids.push_back(internal::prism_of(drill, options_.drain));
    CancelOnly quiet(repair_.progress);
    BooleanOptions options;
    options.repair = repair_;
    options.repair.progress = &quiet;
    options.repair.join_gaps = {};
    options.repair.keep = {};
    options.repair.fewer = {};
    options.repair.reach = {};
    options.repair.opacity = {};
    options.repair.states = nullptr;
    options.repair.explain = false;
    options.repair.examine = nullptr;
    BooleanReport told;
    Surface result = boolean(solids, SetOperation::subtract, options, told);
    internal::replace_result(report_, told.result);
    count_drilled(result);
    return result;
  }

  // Triangles that drains go through are whole no more.
  void count_drilled(const Surface& result) {
    const std::vector<IndexTriangle>& given = solid_.mesh.triangles;
    std::vector<char> is_whole(given.size(), 0);
    for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t) {
      const std::uint32_t source = result.source[t];
      if (source == Surface::kNoSource || source >= given.size()) continue;
      const auto is_corner = [&](std::uint32_t p) {
        return std::any_of(given[source].begin(), given[source].end(), [&](std::uint32_t q) {
          return solid_.mesh.points[q] == result.mesh.points[p];
        });
      };
      const IndexTriangle& corners = result.mesh.triangles[t];
      if (std::all_of(corners.begin(), corners.end(), is_corner)) is_whole[source] = 1;
    }
    TriangleFates& fates = report_.triangles;
    const auto drilled = static_cast<std::size_t>(std::count(is_whole.begin(), is_whole.end(), 0));
    const std::size_t changed = std::min(drilled, fates.untouched);
    fates.untouched -= changed;
    fates.cut += changed;
  }

  // Of a triangle of the result, the cavity whose wall it is a part of.
  [[nodiscard]] std::uint32_t cavity_of(std::uint32_t source) const {
    const std::size_t first = solid_.mesh.triangles.size();
    if (source == Surface::kNoSource || source < first) return kNoCavity;
    return source - first < cavity_of_wall_.size() ? cavity_of_wall_[source - first] : kNoCavity;
  }

  // On the coordinates of the result.
  void measure_walls(const Surface& result) {
    std::vector<std::uint32_t> walls;
    for (std::uint32_t t = 0; t < result.source.size(); ++t) {
      if (cavity_of(result.source[t]) != kNoCavity) walls.push_back(t);
    }
    const WallMaker::Bounds all = maker_.measure(result.mesh, walls);
    hollowed_.least = all.least;
    hollowed_.most = all.most;
    hollowed_.unproven += all.beside;
  }

  // A void that is closed has a component of its own around it, turned inward.
  void look_for_voids(const Surface& result) {
    TopologyPlaces places;
    const auto& triangles = result.mesh.triangles;
    const Topology topology = examine_topology(triangles, result.mesh.points.size(), &places);
    const std::vector<PartSize> sizes =
        part_sizes(result.mesh.points, triangles, places.parts,
                   static_cast<std::uint32_t>(topology.parts), UnitScale(result.mesh.points));
    for (Cavity& cavity : hollowed_.cavities) cavity.opens = true;
    for (std::uint32_t t = 0; t < result.source.size(); ++t) {
      const std::uint32_t cavity = cavity_of(result.source[t]);
      if (cavity != kNoCavity && sizes[places.parts[t]].volume < 0) {
        hollowed_.cavities[cavity].opens = false;
      }
    }
  }

  // Of walls there are none.
  void name_sources(Surface& result) const {
    for (std::uint32_t& source : result.source) {
      if (source >= solid_.mesh.triangles.size()) source = Surface::kNoSource;
    }
  }

  static constexpr std::uint32_t kNoCavity = ~std::uint32_t{0};

  const Surface& solid_;
  const HollowOptions& options_;
  const RepairOptions& repair_;
  HollowReport& hollowed_;
  RepairReport& report_;
  const WallMaker maker_;
  StageMeter meter_;
  Cavities found_;
  TriangleSoup walls_;  // of all cavities that are made
  std::vector<std::uint32_t> cavity_of_wall_;
  std::vector<CavityPlaces> all_places_, places_;  // also of those that stay full
  std::vector<Drill> drills_;
};

void check(const Surface& solid, const HollowOptions& options) {
  if (!(options.wall > 0) || !std::isfinite(options.wall)) {
    throw UsageError("--hollow: the wall needs a thickness above 0");
  }
  if (!(options.drain >= 0) || !std::isfinite(options.drain)) {
    throw UsageError("--drain: a diameter is above 0");
  }
  if (!options.drains_at.empty() && options.drain == 0) {
    throw UsageError("--drain-at: drains need a diameter, by --drain");
  }
  if (options.drain > 0) internal::check_length(solid.mesh, options.drain, "--drain");
  internal::check_length(solid.mesh, options.wall, "--hollow");
}

}  // namespace

Surface hollow(const Surface& solid, const HollowOptions& options, const RepairOptions& repair,
               HollowReport& hollowed, RepairReport& report) {
  check(solid, options);
  return Hollower(solid, options, repair, hollowed, report).run();
}

}  // namespace meshrepair
