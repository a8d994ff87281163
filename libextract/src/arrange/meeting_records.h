// SPDX-License-Identifier: MIT
// What pairs of triangles tell about the points and segments in which they meet.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <base/ids.h>
#include <base/progress.h>

#include "arranged_points.h"
#include "cut_set.h"

namespace meshrepair::internal {

// A segment inside a cut triangle, in which another one meets it, or an edge of another one lies.
struct CutSegment {
  std::uint32_t cut = 0;       // the triangle that it is in
  std::uint32_t by = 0;        // the other one
  std::uint32_t edge = kNone;  // of the other one, if all of the segment lies on it
  PlaneId plane;               // contains the segment, and is not parallel to the triangle
  PointName from, to;
};

struct PointOnEdge {
  std::uint32_t edge = 0;
  PointName point;
};

// A single point inside a triangle that a corner of another one touches.
struct Contact {
  std::uint32_t cut = 0;
  PointName point;
};

struct MeetingRecords {
  std::vector<CutSegment> segments;
  std::vector<PointOnEdge> on_edges;
  std::vector<Contact> contacts;
};

// In the order of the pairs, whatever the number of threads. Throws Cancelled.
[[nodiscard]] MeetingRecords record_meetings(const CutSet& cut, std::span<const CutSet::Pair> pairs,
                                             ProgressObserver* progress);

}  // namespace meshrepair::internal
