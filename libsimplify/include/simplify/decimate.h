// SPDX-License-Identifier: MIT
// Fewer triangles for the boundary of a solid, which stays one.
//
//   DecimationOptions options;
//   options.triangles = 10'000;
//   DecimationReport report;
//   const DecimatedMesh fewer = decimate(mesh, options, report);
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <base/progress.h>
#include <mesh/precision.h>
#include <mesh/soup.h>

namespace meshrepair {

// Knows where the surface may be, and is asked before each collapse.
class CollapseJudge {
 public:
  struct Question {
    std::uint32_t point = 0;                                  // that stays, and moves
    Vec3d place = Vec3d::Zero();                              // to here, in the mesh's units
    std::vector<std::array<std::uint32_t, 3>> before, after;  // triangles, by points of the input
  };
  virtual ~CollapseJudge() = default;
  [[nodiscard]] virtual bool allows(const Question& question) = 0;
  // The collapse that was asked about last is made.
  virtual void note_made(const Question& question) = 0;
};

struct DecimationOptions {
  // No more than so many are wanted; there may be one fewer.
  std::size_t triangles = 0;
  // Points of the input are to stay so near the mesh, and points of the mesh so near the input; in
  // the mesh's units. What lies between them may be a little farther: see mesh_distance().
  double distance = std::numeric_limits<double>::infinity();
  // Tests whether the surface stays where it is to be, instead of the distance, which then only
  // spares it questions about what is twice as far away in the mean. Not owned.
  CollapseJudge* judge = nullptr;
  // Of each point whether it may go. Not owned. Empty: all may.
  enum class Stay : std::uint8_t {
    no,
    yes,
    alone,  // and no other one comes to it: its corners have values of their own
  };
  std::span<const Stay> stays = {};
  // Of new points.
  Precision precision = Precision::float64;
  // Of each triangle, a bit for each side that is a seam, 1 << k for the one from corner k to the
  // next: seams stay where they are as well as the surface does, and no two become one. An edge is
  // a seam on both sides or on none. Not owned. Empty: there are none.
  std::span<const std::uint8_t> seams = {};
  // Of each corner, so many numbers that matter as much as being off the surface by them, in the
  // mesh's units, would: colours and places in pictures. They may differ on both sides of a seam.
  // Not owned. Empty: there are none.
  std::span<const double> values = {};
  std::size_t values_of_corner = 0;
  bool find_corners = false;             // whether DecimatedMesh::corners is wanted
  ProgressObserver* progress = nullptr;  // not owned; no stage is begun
};

struct DecimationReport {
  std::size_t collapses = 0;
  // Edges that are left because their collapse would ...
  std::size_t would_change_topology = 0;  // join surfaces or holes, or leave no solid
  std::size_t would_break_seam = 0;       // move the end of a seam, or join two
  std::size_t would_fold = 0;             // turn a triangle over, or make a needle of it
  std::size_t would_meet = 0;             // make triangles meet, or a part swallow another one
  std::size_t would_part = 0;             // part the surfaces farther than they may be
};

// A place on a triangle of the input.
struct CornerPlace {
  std::uint32_t triangle = 0;
  Vec3d place = Vec3d::Zero();
};

struct DecimatedMesh {
  TriangleSoup mesh;
  // Of each triangle, that of the input which it was.
  std::vector<std::uint32_t> source;
  // Of each point of the input, the one of the mesh that it was collapsed into; or stayed.
  std::vector<std::uint32_t> point;
  // Of corner k of triangle t at 3 t + k, if wanted: where the input is nearest to it, on the side
  // of all seams that the triangle is on. Corners of a point that no seam parts have the same.
  std::vector<CornerPlace> corners;
};

// Collapses edges, the one that changes the surface least first, as measured by quadrics (M.
// Garland and P. Heckbert: Surface simplification using quadric error metrics, 1997).
//
// Pre: the mesh is the boundary of a solid, as valid_solid() has it: closed, a 2-manifold by its
// indices, and triangles meet in corners and edges alone. So is the result: every collapse is
// tested exactly, with all triangles that are near. Parts and their genus stay; points that share
// their place with others stay where they are. The same for any number of threads. Throws
// Cancelled. n log n.
[[nodiscard]] DecimatedMesh decimate(const TriangleSoup& mesh, const DecimationOptions& options,
                                     DecimationReport& report);

}  // namespace meshrepair
