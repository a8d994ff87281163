// SPDX-License-Identifier: MIT
// Bodies that touch or overlap, divided so that no two have a point inside both, with common faces:
// each face between two of them is there once, and both have it. That is what meshers for finite
// elements need of several materials.
//
//   ConformingBodies bodies = conforming_bodies(solids, {}, report);
//   for (std::size_t t = 0; t < bodies.mesh.triangles.size(); ++t) {
//     const auto& [front, behind] = bodies.regions_of[t];  // 0: outside, k: solid k - 1
//   }
//
// Guarantees, once report.passed(): no two triangles meet but in corners and sides that both have;
// the triangles of each region bound it: around each side, a region ends where the next one begins.
// So the exact volumes of all regions add up to that of their union. Triangles that nothing meets
// come out bit for bit.
//
// Faces of two bodies that lie on each other but for rounding are joined first: those no farther
// apart than four steps of the common grid, or of single precision if no coordinate has more
// digits. JoinGapsReport tells of it; its `left` is not 0 where that cannot be done.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <base/progress.h>
#include <base/stage_meter.h>
#include <boolean/boolean.h>
#include <mesh/precision.h>
#include <mesh/region_mesh.h>
#include <mesh/soup.h>
#include <repair/join_gaps.h>

namespace meshrepair {

// To which body a place belongs that several are around.
enum class Overlap {
  first,    // to the first of them
  last,     // to the last
  smaller,  // to the one of the least volume, of equal ones the first
  own,      // to none: what the same bodies are around is a region of its own
};

struct BodiesOptions {
  Overlap overlap = Overlap::first;
  JoinGapsOptions join_gaps = {};            // of all bodies together, before they are divided
  Precision precision = Precision::float64;  // of the coordinates that are certified
  ProgressObserver* progress = nullptr;  // not owned; stages "join_gaps", "operands", "divide" and
                                         // "certify"
};

// A body, or what is left of it.
struct BodyRegion {
  std::vector<std::uint32_t> bodies;  // that are around it, ascending: one, unless it is an overlap
  double volume = 0;                  // in the unit of the input, cubed
  std::size_t triangles = 0;          // that bound it
  std::size_t parts = 0;              // that it falls into, which have no face in common
};

// Two regions, a < b, that have faces in common; a is 0 for what is outside.
struct BodyContact {
  std::uint32_t a = 0, b = 0;
  std::size_t triangles = 0;
  double area = 0;
};

struct ConformingBodies {
  TriangleSoup mesh;  // without two points in one place
  // Of each triangle, the region in front, from where it is counter-clockwise, and that behind: 0
  // is outside, others are 1 + their place in `regions`. Where one is outside, it is in front.
  std::vector<std::array<std::uint32_t, 2>> regions_of;
  // Regions fall into parts that have no face in common, numbered from 1; 0 is the outside, and
  // other parts of the outside are voids. Of each triangle that in front and that behind, and of
  // each part its region.
  std::vector<std::array<std::uint32_t, 2>> parts_of;
  std::vector<std::uint32_t> region_of_part;
  // Of each triangle one in which it lies, counted through those of all solids.
  std::vector<std::uint32_t> source;
  std::vector<BodyRegion> regions;    // of all bodies, in their order, then overlaps
  std::vector<BodyContact> contacts;  // ascending
  // One for each part and each void, but for those too thin for a point that is surely inside.
  std::vector<RegionSeed> seeds;
};

struct BodiesReport {
  JoinGapsReport join_gaps;
  std::vector<OperandReport> operands;  // of all bodies, on their common grid
  std::size_t cut_triangles = 0;        // of the bodies, that met others
  std::size_t overlaps = 0;        // different sets of bodies that had points inside all of them
  double overlap_volume = 0;       // of those points
  std::size_t pairs_at_first = 0;  // of triangles that met once points were rounded
  std::size_t moves = 0;           // of points and edges, so that fewer meet
  double moved_by = 0;             // at most
  std::size_t pairs = 0;           // that are left, and triangles without area
  std::size_t turned_edges = 0;    // around which a region does not end where the next one begins
  std::size_t turned_parts = 0;    // of regions, and voids, whose volume, rounded, is not above 0
  std::vector<StageReport> stages;

  [[nodiscard]] bool passed() const { return pairs + turned_edges + turned_parts == 0; }
};

// first, last, smaller, own.
[[nodiscard]] std::string_view overlap_name(Overlap overlap);

// `solids` are closed surfaces without self-intersections, turned outward, as repair() returns
// them; one without triangles is nothing. The same for any number of threads. Throws InputError
// where there is no solid, where one is nothing on the grid of 26 bits over all, or where more
// triangles meet than can be divided; Cancelled.
[[nodiscard]] ConformingBodies conforming_bodies(std::span<const TriangleSoup> solids,
                                                 const BodiesOptions& options,
                                                 BodiesReport& report);

// Of each region its boundary, as triangles turned outward, and the points that they have, in their
// order. A region that touches itself along an edge has four triangles there.
[[nodiscard]] std::vector<TriangleSoup> boundaries_of(const ConformingBodies& bodies);

}  // namespace meshrepair
