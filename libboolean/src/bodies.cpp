// SPDX-License-Identifier: MIT
// All bodies are arranged together, exactly, and each chamber goes to a region by the bodies around
// it. What lies between two regions is the result, once its new points are rounded. Where that
// brings triangles to meet, their corners go to multiples of a grid's unit, which brings together
// what is narrower, and the regions are divided again; the unit grows until nothing meets. A region
// keeps its number.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <base/disjoint_sets.h>
#include <base/error.h>
#include <base/ids.h>
#include <base/stage_meter.h>
#include <boolean/bodies.h>
#include <bsp/common_grid.h>
#include <check/self_intersections.h>
#include <exact/double_predicates.h>
#include <extract/arrange.h>
#include <mesh/edge_table.h>
#include <mesh/topology.h>

#include "chamber_solids.h"
#include "joined_solids.h"
#include "operands.h"
#include "point_inside.h"

namespace meshrepair {
namespace {

using internal::JoinedSolids;

constexpr std::uint32_t kOutside = 0;

// Of moving points; each goes twice as far as the one before.
constexpr std::size_t kMostRounds = 10;
// How many times as many triangles as at first are too many.
constexpr std::size_t kMostGrowth = 4;
// That are looked at in a round.
constexpr std::size_t kMostPairs = 200'000;

// What is in front of triangles and behind them.
using TriangleSides = std::vector<std::array<std::uint32_t, 2>>;

// Triangles between regions, as in ConformingBodies.
struct Complex {
  TriangleSoup mesh;
  TriangleSides parts_of;
  std::vector<std::uint32_t> region_of_part;
  std::vector<std::uint32_t> source;

  [[nodiscard]] TriangleSides regions_of() const {
    TriangleSides regions;
    regions.reserve(parts_of.size());
    for (const auto& [front, behind] : parts_of) {
      regions.push_back({region_of_part[front], region_of_part[behind]});
    }
    return regions;
  }
};

// Chambers of one region that are next to each other are one part.
struct Parts {
  std::vector<std::uint32_t> of_chamber;
  std::vector<std::uint32_t> region;  // of each; the outside is part 0

  Parts(const std::vector<std::uint32_t>& region_of_chamber, std::span<const ChamberWall> walls) {
    DisjointSets joined(region_of_chamber.size());
    for (const ChamberWall& wall : walls) {
      if (region_of_chamber[wall.below] != region_of_chamber[wall.above]) continue;
      joined.join(wall.below, wall.above);
    }
    std::vector<std::uint32_t> number(region_of_chamber.size(), kNone);
    for (std::uint32_t c = 0; c < region_of_chamber.size(); ++c) {
      std::uint32_t& part = number[joined.root(c)];
      if (part == kNone) {
        part = static_cast<std::uint32_t>(region.size());
        region.push_back(region_of_chamber[c]);
      }
      of_chamber.push_back(part);
    }
  }
};

// The region of what several bodies are around.
class OverlapRule {
 public:
  OverlapRule(Overlap overlap, std::vector<double> volumes)
      : overlap_(overlap), volume_(std::move(volumes)) {}

  // `bodies` ascend, and there is one at least.
  [[nodiscard]] std::uint32_t body_of(const std::vector<std::uint32_t>& bodies) const {
    switch (overlap_) {
      case Overlap::last:
        return bodies.back();
      case Overlap::smaller:
        return *std::min_element(bodies.begin(), bodies.end(), [&](auto a, auto b) {
          return volume_[a] != volume_[b] ? volume_[a] < volume_[b] : a < b;
        });
      default:
        return bodies.front();
    }
  }
  [[nodiscard]] bool divides_off(const std::vector<std::uint32_t>& bodies) const {
    return overlap_ == Overlap::own && bodies.size() > 1;
  }

 private:
  Overlap overlap_;
  std::vector<double> volume_;
};

// Makes complexes of solids, one after the other.
class Divider {
 public:
  Divider(std::size_t bodies, OverlapRule rule, ProgressObserver* progress)
      : bodies_(bodies), rule_(std::move(rule)), quiet_(progress) {}

  // `given`: of each solid, how many triangles it had.
  [[nodiscard]] Complex divide(std::vector<CleanSoup> soups, std::span<const std::size_t> given,
                               ArrangeReport& report) {
    const JoinedSolids joined(std::move(soups), given);
    if (joined.soup().triangles.empty()) return {};
    const auto arrangement = Arrangement::make(joined.soup(), report, &quiet_);
    if (!arrangement) {
      throw InputError("too many triangles of the bodies meet to divide them");
    }
    auto solids = internal::solids_of_chambers(*arrangement, joined);
    if (!solids) solids = internal::likely_solids_of_chambers(*arrangement, joined, &quiet_);
    const std::vector<std::uint32_t> region = regions_of(*solids, arrangement->volumes());
    Parts parts(region, arrangement->walls());
    auto faces = arrangement->faces(parts.of_chamber, &quiet_);
    if (!faces) throw InputError("the faces of the bodies cannot be triangulated");
    Complex complex;
    complex.region_of_part = std::move(parts.region);
    complex.mesh = std::move(faces->surface.mesh);
    complex.source = std::move(faces->surface.source);
    complex.parts_of = std::move(faces->regions);
    // A void has a higher number than the outside, and may be behind.
    for (std::size_t t = 0; t < complex.parts_of.size(); ++t) {
      auto& [front, behind] = complex.parts_of[t];
      if (complex.region_of_part[behind] != kOutside) continue;
      std::swap(front, behind);
      std::swap(complex.mesh.triangles[t][1], complex.mesh.triangles[t][2]);
    }
    return complex;
  }

  // Of each region the bodies around it.
  [[nodiscard]] const std::vector<std::vector<std::uint32_t>>& overlaps() const {
    return overlaps_;
  }
  // In cubic steps of the grid.
  [[nodiscard]] double overlap_volume() const { return overlap_volume_; }

  [[nodiscard]] std::size_t sets_that_overlap() const { return sets_; }

 private:
  // Of each chamber.
  std::vector<std::uint32_t> regions_of(const std::vector<std::vector<std::uint32_t>>& solids,
                                        const std::vector<double>& volumes) {
    std::set<std::vector<std::uint32_t>> sets;
    for (std::size_t c = 0; c < solids.size(); ++c) {
      if (solids[c].size() < 2) continue;
      sets.insert(solids[c]);
      overlap_volume_ += volumes[c];
    }
    sets_ = sets.size();
    std::map<std::vector<std::uint32_t>, std::uint32_t> number;
    for (const auto& set : sets) {
      if (!rule_.divides_off(set)) continue;
      number[set] = static_cast<std::uint32_t>(1 + bodies_ + overlaps_.size());
      overlaps_.push_back(set);
    }
    std::vector<std::uint32_t> region(solids.size(), kOutside);
    for (std::size_t c = 0; c < solids.size(); ++c) {
      if (solids[c].empty()) continue;
      region[c] = rule_.divides_off(solids[c]) ? number[solids[c]] : 1 + rule_.body_of(solids[c]);
    }
    return region;
  }

  std::size_t bodies_;
  OverlapRule rule_;
  CancelOnly quiet_;
  std::vector<std::vector<std::uint32_t>> overlaps_;
  std::size_t sets_ = 0;
  double overlap_volume_ = 0;
};

// Takes the boundaries of regions, or of parts, out of a mesh.
class BoundaryTaker {
 public:
  BoundaryTaker(const TriangleSoup& mesh, const TriangleSides& sides)
      : mesh_(mesh), sides_(sides), number_(mesh.points.size(), kNone) {}

  // Of the listed triangles, which bound it: turned outward, with the points that they have.
  TriangleSoup take(std::span<const std::uint32_t> triangles, std::uint32_t region) {
    TriangleSoup result;
    used_.clear();
    for (const std::uint32_t t : triangles) {
      IndexTriangle corners = mesh_.triangles[t];
      if (sides_[t][1] != region) std::swap(corners[1], corners[2]);
      for (std::uint32_t& p : corners) {
        if (number_[p] == kNone) {
          number_[p] = static_cast<std::uint32_t>(used_.size());
          used_.push_back(p);
        }
        p = number_[p];
      }
      result.triangles.push_back(corners);
    }
    for (const std::uint32_t p : used_) {
      result.points.push_back(mesh_.points[p]);
      number_[p] = kNone;
    }
    return result;
  }

 private:
  const TriangleSoup& mesh_;
  const TriangleSides& sides_;
  std::vector<std::uint32_t> number_;  // of each point, in what is being taken
  std::vector<std::uint32_t> used_;
};

// Of each region or part but number 0, the triangles that bound it, ascending.
std::vector<std::vector<std::uint32_t>> triangles_around(const TriangleSides& sides,
                                                         std::size_t count) {
  std::vector<std::vector<std::uint32_t>> triangles(count);
  for (std::uint32_t t = 0; t < sides.size(); ++t) {
    for (const std::uint32_t r : sides[t]) {
      if (r != 0) triangles[r - 1].push_back(t);
    }
  }
  return triangles;
}

// What is wrong with a complex once its points are rounded.
struct Faults {
  std::size_t count = 0;                 // of pairs that meet, and of triangles without area
  std::vector<std::uint32_t> triangles;  // some of those of pairs, and those without area
};

Faults find_faults(const TriangleSoup& mesh, ProgressObserver* progress) {
  SelfIntersectionOptions options;
  options.weld = false;
  options.most_pairs = kMostPairs;
  options.progress = progress;
  const SelfIntersections found = self_intersections(mesh, options);
  Faults faults;
  faults.count = found.count + found.degenerate + found.not_finite;
  for (const auto& pair : found.pairs) {
    faults.triangles.insert(faults.triangles.end(), pair.begin(), pair.end());
  }
  if (found.degenerate == 0) return faults;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (projection_axis(mesh.points[a], mesh.points[b], mesh.points[c]) < 0) {
      faults.triangles.push_back(t);
    }
  }
  return faults;
}

// As it can be written.
void round_points(Precision precision, TriangleSoup& mesh) {
  for (Vec3d& p : mesh.points) p = internal::rounded_to(p, precision);
}

// Brings the corners of some triangles to multiples of a unit.
void snap(std::span<const std::uint32_t> triangles, double unit, TriangleSoup& mesh,
          BodiesReport& report) {
  std::vector<char> is_snapped(mesh.points.size(), 0);
  for (const std::uint32_t t : triangles) {
    for (const std::uint32_t p : mesh.triangles[t]) {
      if (std::exchange(is_snapped[p], 1) != 0) continue;
      const Vec3d from = mesh.points[p];
      for (int k = 0; k < 3; ++k) mesh.points[p][k] = std::nearbyint(from[k] / unit) * unit;
      const double by = (mesh.points[p] - from).cwiseAbs().maxCoeff();
      if (by > 0) ++report.snapped_points;
      report.snapped_by = std::max(report.snapped_by, by);
    }
  }
}

// The complex as it comes out of the division of its own regions.
Complex divided_again(const Complex& complex, std::size_t regions, const Grid& grid,
                      ProgressObserver* progress) {
  std::vector<CleanSoup> soups;
  std::vector<std::size_t> given;
  std::vector<std::uint32_t> source;
  const TriangleSides regions_of = complex.regions_of();
  BoundaryTaker taker(complex.mesh, regions_of);
  for (const auto& triangles : triangles_around(regions_of, regions)) {
    const auto region = static_cast<std::uint32_t>(soups.size() + 1);
    CleanReport cleaned;
    soups.push_back(clean_soup(taker.take(triangles, region), grid, cleaned, progress));
    given.push_back(triangles.size());
    for (const std::uint32_t t : triangles) source.push_back(complex.source[t]);
  }
  Divider divider(regions, OverlapRule(Overlap::first, {}), progress);
  ArrangeReport arranged;
  Complex again = divider.divide(std::move(soups), given, arranged);
  for (std::uint32_t& t : again.source) t = source[t];
  return again;
}

// Until nothing meets any more; if that takes too long, the best is left.
void make_sound(std::size_t regions, const Grid& grid, Precision precision, Complex& complex,
                BodiesReport& report, ProgressObserver* progress) {
  CancelOnly quiet(progress);
  round_points(precision, complex.mesh);
  Faults faults = find_faults(complex.mesh, &quiet);
  report.pairs_at_first = report.pairs = faults.count;
  const std::size_t most_triangles = kMostGrowth * complex.mesh.triangles.size();
  double unit = std::max(grid.unit, internal::number_spacing(complex.mesh, precision));
  Complex best = faults.count > 0 ? complex : Complex();
  BodiesReport moved;
  while (faults.count > 0 && report.rounds < kMostRounds) {
    ++report.rounds;
    snap(faults.triangles, unit, complex.mesh, moved);
    complex = divided_again(complex, regions, grid, &quiet);
    round_points(precision, complex.mesh);
    faults = find_faults(complex.mesh, &quiet);
    if (faults.count < report.pairs) {
      report.pairs = faults.count;
      report.snapped_points = moved.snapped_points;
      report.snapped_by = moved.snapped_by;
      best = complex;
    }
    if (complex.mesh.triangles.size() > most_triangles) break;
    unit *= 2;
  }
  if (report.rounds > 0) complex = std::move(best);
}

// Sides of a region's boundary that are not passed as often one way as the other.
std::size_t open_edges(const TriangleSoup& surface) {
  std::size_t open = 0;
  EdgeTable(surface.triangles).for_each_edge([&](std::span<const std::uint32_t> sides) {
    std::ptrdiff_t balance = 0;
    for (const std::uint32_t s : sides) {
      const bool up =
          side_start(surface.triangles, s) < side_start(surface.triangles, next_side(s));
      balance += up ? 1 : -1;
    }
    if (balance != 0) ++open;
  });
  return open;
}

// Places inside all parts but the outside.
void find_seeds(const Complex& complex, ConformingBodies& bodies) {
  const auto all = triangles_around(complex.parts_of, complex.region_of_part.size() - 1);
  BoundaryTaker taker(complex.mesh, complex.parts_of);
  for (std::uint32_t part = 1; part <= all.size(); ++part) {
    const std::uint32_t region = complex.region_of_part[part];
    if (region != kOutside) ++bodies.regions[region - 1].parts;
    if (const auto place = internal::point_inside(taker.take(all[part - 1], part))) {
      bodies.seeds.push_back({region, *place});
    }
  }
}

void measure(ConformingBodies& bodies, BodiesReport& report) {
  const auto all = triangles_around(bodies.regions_of, bodies.regions.size());
  BoundaryTaker taker(bodies.mesh, bodies.regions_of);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const TriangleSoup surface = taker.take(all[i], static_cast<std::uint32_t>(i + 1));
    BodyRegion& region = bodies.regions[i];
    region.triangles = surface.triangles.size();
    region.volume = signed_volume(surface);
    report.open_edges += open_edges(surface);
  }
  std::map<std::array<std::uint32_t, 2>, BodyContact> contacts;
  for (std::size_t t = 0; t < bodies.regions_of.size(); ++t) {
    const auto [a, b] = std::minmax(bodies.regions_of[t][0], bodies.regions_of[t][1]);
    const auto& [p, q, r] = bodies.mesh.triangles[t];
    const std::vector<Vec3d>& at = bodies.mesh.points;
    BodyContact& contact = contacts[{a, b}];
    contact.a = a;
    contact.b = b;
    ++contact.triangles;
    contact.area += 0.5 * (at[q] - at[p]).cross(at[r] - at[p]).norm();
  }
  for (const auto& [pair, contact] : contacts) bodies.contacts.push_back(contact);
}

// On the grid of all.
std::vector<CleanSoup> clean_bodies(std::span<const TriangleSoup> solids, const Grid& grid,
                                    BooleanReport& operands, ProgressObserver* progress) {
  BooleanOptions cleaning;
  cleaning.repair.progress = progress;
  std::vector<CleanSoup> soups;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    soups.push_back(internal::clean_operand(solids[i], i, grid, cleaning, operands));
  }
  return soups;
}

// Once gaps are joined.
ConformingBodies divide(std::span<const TriangleSoup> solids, const BodiesOptions& options,
                        BodiesReport& report) {
  StageMeter meter(report.stages, options.progress);
  meter.begin("operands");
  BooleanReport operands;
  const Grid grid = internal::grid_of(solids, operands);
  CancelOnly quiet(options.progress);
  std::vector<CleanSoup> soups = clean_bodies(solids, grid, operands, &quiet);
  report.operands = std::move(operands.operands);
  std::vector<std::size_t> given;
  std::vector<double> volumes;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    given.push_back(solids[i].triangles.size());
    volumes.push_back(report.operands[i].volume);
  }
  Divider divider(solids.size(), OverlapRule(options.overlap, std::move(volumes)),
                  options.progress);
  ArrangeReport arranged;
  meter.begin("divide");
  Complex complex = divider.divide(std::move(soups), given, arranged);
  report.cut_triangles = arranged.cut_triangles;
  report.overlaps = divider.sets_that_overlap();
  report.overlap_volume = divider.overlap_volume() * grid.unit * grid.unit * grid.unit;
  ConformingBodies bodies;
  for (std::uint32_t i = 0; i < solids.size(); ++i) bodies.regions.push_back({{i}});
  for (const auto& set : divider.overlaps()) bodies.regions.push_back({set});
  meter.begin("certify");
  make_sound(bodies.regions.size(), grid, options.precision, complex, report, options.progress);
  if (!complex.region_of_part.empty()) find_seeds(complex, bodies);
  bodies.regions_of = complex.regions_of();
  bodies.mesh = std::move(complex.mesh);
  bodies.parts_of = std::move(complex.parts_of);
  bodies.region_of_part = std::move(complex.region_of_part);
  bodies.source = std::move(complex.source);
  measure(bodies, report);
  return bodies;
}

}  // namespace

std::string_view overlap_name(Overlap overlap) {
  constexpr std::array<std::string_view, 4> kNames = {"first", "last", "smaller", "own"};
  return kNames.at(static_cast<std::size_t>(overlap));
}

ConformingBodies conforming_bodies(std::span<const TriangleSoup> solids,
                                   const BodiesOptions& options, BodiesReport& report) {
  report = {};
  BooleanOptions joining;
  joining.repair.join_gaps = options.join_gaps;
  joining.repair.progress = options.progress;
  RepairReport before;
  const auto joined = internal::join_operands(solids, joining, before);
  report.join_gaps = before.join_gaps;
  report.stages = std::move(before.stages);
  if (!joined) return divide(solids, options, report);
  ConformingBodies bodies = divide(joined->solids, options, report);
  for (std::uint32_t& t : bodies.source) t = internal::given_source(*joined, t);
  return bodies;
}

std::vector<TriangleSoup> boundaries_of(const ConformingBodies& bodies) {
  std::vector<TriangleSoup> boundaries;
  BoundaryTaker taker(bodies.mesh, bodies.regions_of);
  for (const auto& triangles : triangles_around(bodies.regions_of, bodies.regions.size())) {
    boundaries.push_back(taker.take(triangles, static_cast<std::uint32_t>(boundaries.size() + 1)));
  }
  return boundaries;
}

}  // namespace meshrepair
