// SPDX-License-Identifier: MIT
// The segments in which one triangle meets others, and where they meet each other.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "arranged_points.h"
#include "cut_set.h"
#include "meeting_records.h"

namespace meshrepair::internal {

// One of them, with what lies on it.
struct CutLine {
  std::uint32_t from = 0, to = 0;  // points
  std::uint32_t by = 0, edge = kNone;
  PlaneId plane;
};

// A point that lies inside a line: one that is known, or the meeting of three triangles.
struct LinePoint {
  std::uint32_t line = 0;
  std::uint32_t point = kNone;
  TripleName triple{};
};

struct CutLines {
  std::vector<CutLine> lines;
  std::vector<LinePoint> points;
  std::vector<std::array<std::uint32_t, 2>> same;  // points at one place
  bool sound = true;                               // all points were found
};

// Of one cut triangle; `contacts` are single points in it.
[[nodiscard]] CutLines find_cut_lines(const CutSet& cut, const ArrangedPoints& points,
                                      std::uint32_t triangle, std::span<const CutSegment> segments,
                                      std::span<const std::uint32_t> contacts);

}  // namespace meshrepair::internal
