// SPDX-License-Identifier: MIT
// Where surfaces cross at a small angle, cutting leaves slivers that exact merging does not take
// away. Edges are collapsed onto one of their ends within a bound on the distance of the two
// surfaces (J. Cohen, D. Manocha and M. Olano: Simplifying polygonal models using successive
// mappings, 1997), the shortest first. Only vertices of cut triangles move.
//
// A collapse looks at its own star, and not at what is near: to ask that at each move would cost
// more than all else. So moves are made first, and tested together: which triangles meet now and
// did not before, which parts changed their volume or face the wrong way. The points to blame stay,
// and all is done again from the start. In the first rounds only the point that changed a triangle
// last stays, later all that came to its corners, so that the rounds end.
//
// Invariant: after each round the surface is closed and manifold, of the same genus, and within the
// bound. What fails is at worst not simplified.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include <base/ids.h>
#include <check/box_tree.h>
#include <check/part_orientation.h>
#include <check/self_intersections.h>
#include <extract/simplify_cuts.h>
#include <mesh/edge_table.h>
#include <mesh/mesh_parts.h>
#include <mesh/weld_points.h>

#include "cut_simplifier.h"
#include "movable_region.h"

namespace meshrepair {
namespace {

using internal::CutSimplifier;
using internal::MovableRegion;

// What is little for the surface is much for a thin part: the bound for its points is its thickness
// divided by this, if that is less.
constexpr double kThinParts = 7;

// No part becomes larger or smaller by more than this share of its volume.
constexpr double kMostChange = 0.1;

// Of the bound: sheets are not to come nearer than this, even if doubles still tell them apart.
constexpr double kNearness = 0x1p-10;

// Rounds in which as few points as may be are told to stay; and those after which all do.
constexpr std::size_t kPatientRounds = 6;
constexpr std::size_t kMostRounds = 64;

// More are found in the next round.
constexpr std::size_t kMostPairs = 200'000;

// The surface at first, and its parts.
struct Original {
  const Surface& surface;
  MeshParts parts;
  UnitScale scale;
  std::vector<PartSize> sizes;

  explicit Original(const Surface& original)
      : surface(original),
        parts(find_parts(original.mesh)),
        scale(original.mesh.points),
        sizes(part_sizes(original.mesh.points, original.mesh.triangles, parts.of_triangle,
                         parts.count, scale)) {}

  // How far the surface around each point may be moved.
  [[nodiscard]] std::vector<double> bounds(double within) const {
    std::vector<double> bounds(surface.mesh.points.size(), within);
    for (std::size_t t = 0; t < parts.of_triangle.size(); ++t) {
      const PartSize& size = sizes[parts.of_triangle[t]];
      // Not divided by the area, which may be 0.
      const double share = kThinParts * scale(within) * size.area;
      if (!(2 * std::abs(size.volume) < share)) continue;
      const double bound = within * (2 * std::abs(size.volume) / share);
      for (const std::uint32_t p : surface.mesh.triangles[t]) {
        bounds[p] = std::min(bounds[p], bound);
      }
    }
    return bounds;
  }
};

// The surface after one run.
struct Candidate {
  TriangleSoup mesh;                   // all points, and the triangles that are left
  std::vector<std::uint32_t> was;      // of each triangle, its number in the original
  std::vector<std::uint32_t> changed;  // triangles that are not as they were
};

// Where parts touch, they have points in the same place. To move one of those would leave gaps that
// no other program can tell from none. Two ends of an edge that rounding brought to one place are
// no contact, but may become one.
void keep_contacts(const TriangleSoup& mesh, std::vector<char>& stays) {
  const PointPlaces places = find_places(mesh.points);
  std::vector<std::uint8_t> points_at(places.place.size(), 0);  // 3: three or more
  for (const std::uint32_t place : places.place) {
    points_at[place] = static_cast<std::uint8_t>(std::min(points_at[place] + 1, 3));
  }
  std::vector<char> is_edge(places.place.size(), 0);
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t place = places.place[t[k]];
      if (place == places.place[t[(k + 1) % 3]] && points_at[place] == 2) is_edge[place] = 1;
    }
  }
  for (std::size_t p = 0; p < stays.size(); ++p) {
    if (places.is_copy[p] != 0 && is_edge[places.place[p]] == 0) stays[p] = 1;
  }
}

void take(const Original& original, const MovableRegion& region, const CutSimplifier& simplifier,
          Candidate& candidate) {
  candidate.mesh.triangles.clear();
  candidate.was.clear();
  candidate.changed.clear();
  const std::vector<IndexTriangle>& triangles = original.surface.mesh.triangles;
  std::uint32_t r = 0;  // in the region
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const bool is_in_region = r < region.triangles().size() && region.triangles()[r] == t;
    IndexTriangle triangle = triangles[t];
    if (is_in_region) {
      const std::uint32_t here = r++;
      if (!simplifier.mesh().is_left(here)) continue;
      if (simplifier.last_moved(here) != CutSimplifier::kNone) {
        candidate.changed.push_back(static_cast<std::uint32_t>(candidate.was.size()));
      }
      const IndexTriangle& corners = simplifier.mesh().triangles()[here];
      for (std::size_t k = 0; k < 3; ++k) triangle[k] = region.points()[corners[k]];
    }
    candidate.was.push_back(t);
    candidate.mesh.triangles.push_back(triangle);
  }
}

Surface surface_of(const Surface& original, const Candidate& candidate) {
  Surface surface = original;
  std::vector<char> is_left(surface.mesh.triangles.size(), 0);
  for (std::size_t t = 0; t < candidate.was.size(); ++t) {
    is_left[candidate.was[t]] = 1;
    surface.mesh.triangles[candidate.was[t]] = candidate.mesh.triangles[t];
  }
  keep_triangles(surface, is_left);
  return surface;
}

// Where moves have brought triangles to meet others. Rounds differ in few places, so each looks
// only at what is not as it was in the last.
class MeetingTest {
 public:
  MeetingTest(const TriangleSoup& original, const SimplifyOptions& options)
      : known_(original.triangles) {
    options_.most_pairs = kMostPairs;
    options_.nearness = kNearness * options.within;
    options_.progress = options.progress;
  }

  // The triangles of pairs that meet, but for pairs that are as in the original.
  std::vector<std::uint32_t> run(const Candidate& candidate) {
    const std::vector<IndexTriangle>& triangles = candidate.mesh.triangles;
    std::vector<std::uint32_t> to_test;
    for (std::uint32_t t = 0; t < candidate.was.size(); ++t) {
      if (known_[candidate.was[t]] != triangles[t]) to_test.push_back(t);
    }
    const SelfIntersections found = self_intersections(candidate.mesh, to_test, options_);
    known_.assign(known_.size(), kUnknown);
    for (std::size_t t = 0; t < candidate.was.size(); ++t) known_[candidate.was[t]] = triangles[t];
    if (found.count > found.pairs.size()) forget(candidate, to_test);
    std::vector<char> is_changed(candidate.was.size(), 0);
    for (const std::uint32_t t : candidate.changed) is_changed[t] = 1;
    std::vector<std::uint32_t> blamed;
    for (const auto& [t, u] : found.pairs) {
      if (is_changed[t] != 0 || is_changed[u] != 0) blamed.insert(blamed.end(), {t, u});
    }
    forget(candidate, blamed);
    return blamed;
  }

 private:
  static constexpr std::array<std::uint32_t, 3> kUnknown{kNone, kNone, kNone};

  void forget(const Candidate& candidate, const std::vector<std::uint32_t>& triangles) {
    for (const std::uint32_t t : triangles) known_[candidate.was[t]] = kUnknown;
  }

  SelfIntersectionOptions options_;
  // Corners of each triangle in the last round, if it met no other one then. At first the
  // original's: what meets there is not to blame on moves.
  std::vector<std::array<std::uint32_t, 3>> known_;
};

// The changed triangles of parts that are not as large as they were.
std::vector<std::uint32_t> resizing_triangles(const Original& original,
                                              const Candidate& candidate) {
  const TriangleSoup& mesh = candidate.mesh;
  std::vector<std::uint32_t> part_of;
  part_of.reserve(candidate.was.size());
  for (const std::uint32_t t : candidate.was) part_of.push_back(original.parts.of_triangle[t]);
  const std::vector<PartSize> sizes =
      part_sizes(mesh.points, mesh.triangles, part_of, original.parts.count, original.scale);
  std::vector<std::uint32_t> blamed;
  for (const std::uint32_t t : candidate.changed) {
    const double volume = original.sizes[part_of[t]].volume;
    const double change = sizes[part_of[t]].volume - volume;
    if (!(std::abs(change) <= kMostChange * std::abs(volume))) blamed.push_back(t);
  }
  return blamed;
}

// A part that another part's surface was moved across faces the wrong way: the changed triangles
// around it.
std::vector<std::uint32_t> turning_triangles(const Candidate& candidate, double within,
                                             ProgressObserver* progress) {
  const TriangleSoup& mesh = candidate.mesh;
  const PartOrientation parts = examine_part_orientation(mesh, progress);
  std::vector<Box> boxes(parts.inside_out.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (parts.inside_out[parts.part_of[t]] == 0) continue;
    for (const std::uint32_t p : mesh.triangles[t]) boxes[parts.part_of[t]].add(mesh.points[p]);
  }
  std::erase_if(boxes, [](const Box& box) { return box.low[0] > box.high[0]; });
  const BoxTree tree(boxes);
  std::vector<std::uint32_t> blamed;
  for (const std::uint32_t t : candidate.changed) {
    Box around;
    for (const std::uint32_t p : mesh.triangles[t]) around.add(mesh.points[p]);
    around.widen(within);
    if (meets_any(tree, boxes, around)) blamed.push_back(t);
  }
  return blamed;
}

// Of each triangle to blame, the point that changed it last; where that takes too many rounds, all
// points that ended in its corners. At least one point more each time.
void take_back(const CutSimplifier& simplifier, const Candidate& candidate,
               const std::vector<std::uint32_t>& blamed, bool all, MovableRegion& region) {
  std::vector<char> is_corner(region.points().size(), 0);
  for (const std::uint32_t t : blamed) {
    const std::optional<std::uint32_t> here = region.find(candidate.was[t]);
    if (!here || simplifier.last_moved(*here) == CutSimplifier::kNone) continue;
    region.stay(simplifier.last_moved(*here));
    for (const std::uint32_t p : simplifier.mesh().triangles()[*here]) is_corner[p] = 1;
  }
  if (!all) return;
  const std::vector<std::uint32_t> places = simplifier.places();
  for (std::uint32_t p = 0; p < places.size(); ++p) {
    if (simplifier.has_moved(p) && is_corner[places[p]] != 0) region.stay(p);
  }
}

// Whether the candidate is as good as the original; if not, what is to blame for it stays.
bool passes(const Original& original, const CutSimplifier& simplifier, const Candidate& candidate,
            const SimplifyOptions& options, bool patient, MeetingTest& meeting,
            MovableRegion& region) {
  std::vector<std::uint32_t> blamed = meeting.run(candidate);
  const bool meet = !blamed.empty();
  if (!meet) blamed = resizing_triangles(original, candidate);
  if (blamed.empty()) blamed = turning_triangles(candidate, options.within, options.progress);
  take_back(simplifier, candidate, blamed, !meet || !patient, region);
  return blamed.empty();
}

std::size_t count_of(const std::vector<char>& flags) {
  return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), 1));
}

// Round by round, until a candidate passes.
std::optional<Surface> simplified(const Original& original, MovableRegion& region,
                                  const SimplifyOptions& options, SimplifyReport& report) {
  const Surface& surface = original.surface;
  MeetingTest meeting(surface.mesh, options);
  CutSimplifier simplifier(region.mesh(), region.stays(), region.within(),
                           {region.source(), options.reach}, options.progress);
  Candidate candidate;
  candidate.mesh.points = surface.mesh.points;
  while (report.rounds < kMostRounds) {
    ++report.rounds;
    simplifier.run();
    take(original, region, simplifier, candidate);
    if (candidate.changed.empty()) return std::nullopt;
    const bool patient = report.rounds <= kPatientRounds;
    if (!passes(original, simplifier, candidate, options, patient, meeting, region)) {
      simplifier.take_back();
      continue;
    }
    Surface simpler = surface_of(surface, candidate);
    report.removed_points = surface.mesh.points.size() - simpler.mesh.points.size();
    report.removed_triangles = surface.mesh.triangles.size() - candidate.was.size();
    report.distance = simplifier.distance();
    return simpler;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Surface> simplify_cuts(const Surface& surface, std::vector<char>& stays,
                                     const SimplifyOptions& options, SimplifyReport& report) {
  report = {};
  if (!(options.within > 0) || count_of(stays) == stays.size()) return std::nullopt;
  const Original original(surface);
  keep_contacts(surface.mesh, stays);
  const std::size_t to_stay = count_of(stays);
  MovableRegion region(surface.mesh, stays, original.bounds(options.within), surface.source);
  std::optional<Surface> simpler = simplified(original, region, options, report);
  region.copy_stays(stays);
  if (simpler) report.points_to_stay = count_of(stays) - to_stay;
  return simpler;
}

}  // namespace meshrepair
