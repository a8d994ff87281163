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
#include <check/near_faces.h>
#include <exact/double_predicates.h>
#include <extract/arrange.h>
#include <mesh/append_soup.h>
#include <mesh/edge_table.h>
#include <mesh/topology.h>

#include "chamber_solids.h"
#include "joined_solids.h"
#include "operands.h"
#include "point_inside.h"
#include "regions/mend_regions.h"

namespace meshrepair {
namespace {

using internal::JoinedSolids;
using internal::MendRegionsOptions;
using internal::MendRegionsReport;
using Complex = internal::RegionComplex;
using internal::TriangleSides;

using internal::kOutside;

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

// Makes a complex of solids.
class Divider {
 public:
  Divider(std::size_t bodies, OverlapRule rule, ProgressObserver* progress)
      : bodies_(bodies), rule_(std::move(rule)), progress_(progress) {}

  [[nodiscard]] Complex divide(const JoinedSolids& joined, ArrangeReport& report) {
    if (joined.soup().triangles.empty()) return {};
    const auto arrangement = Arrangement::make(joined.soup(), report, progress_);
    if (!arrangement) {
      throw InputError("too many triangles of the bodies meet to divide them");
    }
    auto solids = internal::solids_of_chambers(*arrangement, joined);
    if (!solids) solids = internal::likely_solids_of_chambers(*arrangement, joined, progress_);
    const std::vector<std::uint32_t> region = regions_of(*solids, arrangement->volumes());
    Parts parts(region, arrangement->walls());
    auto faces = arrangement->faces(parts.of_chamber, progress_);
    if (!faces) throw InputError("the faces of the bodies cannot be triangulated");
    Complex complex;
    complex.region_of_part = std::move(parts.region);
    complex.mesh = std::move(faces->surface.mesh);
    complex.source = std::move(faces->surface.source);
    complex.parts_of = std::move(faces->regions);
    // A void has a higher number than the outside, and may be behind.
    internal::turn_outside_to_front(complex);
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
  ProgressObserver* progress_;  // not owned
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

// As it can be written.
void round_points(Precision precision, TriangleSoup& mesh) {
  for (Vec3d& p : mesh.points) p = internal::rounded_to(p, precision);
}

// Until nothing meets any more, as far as that can be.
void make_sound(const Grid& grid, Precision precision, Complex& complex, BodiesReport& report,
                ProgressObserver* progress) {
  CancelOnly quiet(progress);
  round_points(precision, complex.mesh);
  MendRegionsOptions options;
  options.precision = precision;
  options.unit = std::max(grid.unit, internal::number_spacing(complex.mesh, precision));
  options.progress = &quiet;
  MendRegionsReport mended;
  internal::mend_regions(complex, options, mended);
  report.pairs_at_first = mended.pairs_at_first;
  report.pairs = mended.pairs;
  report.turned_edges = mended.turned_edges;
  report.turned_parts = mended.turned_parts;
  report.moves = mended.edits;
  report.moved_by = mended.distance;
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

void measure(ConformingBodies& bodies) {
  const auto all = triangles_around(bodies.regions_of, bodies.regions.size());
  BoundaryTaker taker(bodies.mesh, bodies.regions_of);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const TriangleSoup surface = taker.take(all[i], static_cast<std::uint32_t>(i + 1));
    BodyRegion& region = bodies.regions[i];
    region.triangles = surface.triangles.size();
    region.volume = signed_volume(surface);
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

// How far rounding takes faces apart that lie on each other: in steps of the grid, or of numbers in
// single precision where the solids have no others.
constexpr double kRoundingSteps = 4;

// All solids, and what rounding may have done to them.
class TouchingBodies {
 public:
  explicit TouchingBodies(std::span<const TriangleSoup> solids) {
    for (std::size_t i = 0; i < solids.size(); ++i) {
      append_soup(all_, solids[i]);
      solid_of_.resize(all_.triangles.size(), i);
    }
    grid_ = internal::grid_of(solids);
    const bool is_single = std::all_of(all_.points.begin(), all_.points.end(), [](const Vec3d& p) {
      return p == internal::rounded_to(p, Precision::float32);
    });
    double step = grid_.unit;
    if (is_single) step = std::max(step, internal::number_spacing(all_, Precision::float32));
    reach_ = kRoundingSteps * step;
  }

  [[nodiscard]] double reach() const { return reach_; }

  // Of faces of two bodies that are as near as that, but not in one plane on the grid.
  [[nodiscard]] std::size_t pairs_taken_apart(ProgressObserver* progress) const {
    NearFacesOptions looking;
    looking.largest_distance = reach_;
    looking.progress = progress;
    const NearFacesFound near = find_near_faces(all_, looking);
    const auto count = std::count_if(near.gaps.begin(), near.gaps.end(), [&](const NearFaces& gap) {
      return solid_of_[gap.a] != solid_of_[gap.b] && !are_in_one_plane(gap.a, gap.b);
    });
    return static_cast<std::size_t>(count);
  }

 private:
  [[nodiscard]] Vec3d on_grid(std::uint32_t point) const {
    return as_vector(grid_.to_grid(all_.points[point]));
  }
  [[nodiscard]] bool are_in_one_plane(std::uint32_t t, std::uint32_t u) const {
    const IndexTriangle& corners = all_.triangles[t];
    const Vec3d a = on_grid(corners[0]), b = on_grid(corners[1]), c = on_grid(corners[2]);
    return std::all_of(all_.triangles[u].begin(), all_.triangles[u].end(),
                       [&](std::uint32_t p) { return orientation(a, b, c, on_grid(p)) == 0; });
  }

  TriangleSoup all_;
  std::vector<std::size_t> solid_of_;  // of each triangle
  Grid grid_;
  double reach_ = 0;
};

// Gaps that were asked for, and faces that touch: cut into the same triangles, they stay on each
// other wherever their corners come to lie on the grid.
std::optional<internal::JoinedOperands> join(std::span<const TriangleSoup> solids,
                                             const BodiesOptions& options, RepairReport& report) {
  const TouchingBodies touching(solids);
  CancelOnly quiet(options.progress);
  const std::size_t apart = touching.pairs_taken_apart(&quiet);
  BooleanOptions joining;
  joining.repair.join_gaps = options.join_gaps;
  if (apart > 0) joining.repair.join_gaps.touching = touching.reach();
  joining.repair.progress = options.progress;
  const bool is_asked_for = options.join_gaps.mode != JoinGapsMode::none;
  if (!is_asked_for && apart == 0) return std::nullopt;
  try {
    return internal::join_operands(solids, joining, report);
  } catch (const ValueError&) {
    if (is_asked_for) throw;
    report.join_gaps.distance = touching.reach();
    report.join_gaps.left = apart;  // something else is as thin
    return std::nullopt;
  }
}

// Once gaps are joined.
ConformingBodies divide(std::span<const TriangleSoup> solids, const BodiesOptions& options,
                        BodiesReport& report) {
  StageMeter meter(report.stages, options.progress);
  meter.begin("operands");
  BooleanReport operands;
  BooleanOptions cleaning;
  CancelOnly quiet(options.progress);
  cleaning.repair.progress = &quiet;
  const JoinedSolids joined = internal::join_solids(solids, cleaning, operands);
  report.operands = std::move(operands.operands);
  std::vector<double> volumes;
  for (const OperandReport& operand : report.operands) volumes.push_back(operand.volume);
  Divider divider(solids.size(), OverlapRule(options.overlap, std::move(volumes)), &quiet);
  ArrangeReport arranged;
  meter.begin("divide");
  Complex complex = divider.divide(joined, arranged);
  report.cut_triangles = arranged.cut_triangles;
  report.overlaps = divider.sets_that_overlap();
  const Grid& grid = joined.soup().grid;
  report.overlap_volume = divider.overlap_volume() * grid.unit * grid.unit * grid.unit;
  ConformingBodies bodies;
  for (std::uint32_t i = 0; i < solids.size(); ++i) bodies.regions.push_back({{i}});
  for (const auto& set : divider.overlaps()) bodies.regions.push_back({set});
  meter.begin("certify");
  make_sound(grid, options.precision, complex, report, options.progress);
  if (!complex.region_of_part.empty()) find_seeds(complex, bodies);
  bodies.regions_of = complex.regions_of();
  bodies.mesh = std::move(complex.mesh);
  bodies.parts_of = std::move(complex.parts_of);
  bodies.region_of_part = std::move(complex.region_of_part);
  bodies.source = std::move(complex.source);
  measure(bodies);
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
  RepairReport before;
  const auto joined = join(solids, options, before);
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
