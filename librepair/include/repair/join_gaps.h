// SPDX-License-Identifier: MIT
// Bodies that touch but for small gaps are brought together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <base/progress.h>
#include <mesh/soup.h>

namespace meshrepair {

enum class JoinGapsMode {
  none,
  automatic,  // as far as the soup itself tells
  distance,   // as far as is asked for
};

struct JoinGapsOptions {
  JoinGapsMode mode = JoinGapsMode::none;
  double distance = 0;    // of JoinGapsMode::distance, in the soup's unit
  bool is_share = false;  // it is a share of the diagonal of the soup's bounding box instead
  ProgressObserver* progress = nullptr;
  // If above 0, faces no farther apart than this are joined also where there is no gap but rounding
  // between any of them: they get the same triangles, which no rounding takes apart. In the soup's
  // unit.
  double touching = 0;
};

struct JoinGapsReport {
  double distance = 0;    // over which gaps are joined at most; 0: none was asked for, or found
  std::size_t pairs = 0;  // of near triangles, with a gap between them
  double widest_gap = 0;  // of these
  std::size_t joined_points = 0;  // that became one with another
  std::size_t new_points = 0;     // where edges cross
  double farthest_move = 0;       // of a corner
  std::size_t left = 0;           // pairs that overlap and are still apart
};

// What is seen of gaps before anything is done about them.
struct GapProposal {
  std::size_t pairs = 0;  // of near triangles
  double widest_gap = 0;  // of these
  double distance = 0;    // that joins them all; 0: there are none
};

struct JoinedSoup {
  TriangleSoup soup;
  std::vector<std::uint32_t> source;  // of each triangle, that of the soup that was given
};

// Faces of different bodies, or such that face each other, that are no farther apart than the
// distance come to lie on each other: corners near corners become one, corners near edges and faces
// come to lie on these and cut them, and edges that cross near each other get a point in common.
// Where faces overlap they then are copies of the same triangles. What is near no such face stays
// where it is.
//
// JoinGapsMode::automatic takes the distance that propose_gaps() finds. Throws ValueError where the
// distance is more than half of what is thin: of a wall, or of an edge at such a face. Nothing if
// there is nothing to join. Throws Cancelled.
[[nodiscard]] std::optional<JoinedSoup> join_gaps(const TriangleSoup& soup,
                                                  const JoinGapsOptions& options,
                                                  JoinGapsReport& report);

// The widest gaps that are far narrower than the next wider ones, than what is thin, and than the
// edges of their triangles. n log n. Throws Cancelled.
[[nodiscard]] GapProposal propose_gaps(const TriangleSoup& soup, ProgressObserver* progress);

// Takes out copies of triangles that face each other: walls inside the solid. Not those of bodies
// of the soup that was given which have open edges.
void drop_facing_copies(const TriangleSoup& given, JoinedSoup& joined);

}  // namespace meshrepair
