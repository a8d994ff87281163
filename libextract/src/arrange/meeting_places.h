// SPDX-License-Identifier: MIT
// Where exactly two triangles meet, told by the corners, sides and insides of both.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <base/vec3.h>

namespace meshrepair::internal {

// A corner k as k, the side from corner k to the next one as 3 + k, the inside as 6.
class Place {
 public:
  static constexpr Place corner(std::size_t k) { return Place(k); }
  static constexpr Place side(std::size_t k) { return Place(3 + k); }
  static constexpr Place inside() { return Place(6); }

  [[nodiscard]] constexpr bool is_corner() const { return value_ < 3; }
  [[nodiscard]] constexpr bool is_side() const { return value_ >= 3 && value_ < 6; }
  [[nodiscard]] constexpr bool is_inside() const { return value_ == 6; }
  // Of the corner or the side.
  [[nodiscard]] constexpr std::size_t number() const { return value_ % 3u; }
  constexpr bool operator==(const Place&) const = default;

 private:
  constexpr explicit Place(std::size_t value) : value_(static_cast<std::uint8_t>(value)) {}
  std::uint8_t value_;
};

struct MeetingPoint {
  Place in_a = Place::inside(), in_b = Place::inside();
  bool operator==(const MeetingPoint&) const = default;
};

// The ends of what a segment and a triangle, or two triangles, have in common: none, one, or two.
struct CommonSegment {
  std::array<MeetingPoint, 2> ends{};
  std::size_t count = 0;

  void add(const MeetingPoint& point);
};

struct TriangleMeeting {
  bool coplanar = false;
  CommonSegment across;  // of two that are not coplanar
  // Of coplanar ones: what side k of a has in common with b, and side k of b with a.
  std::array<CommonSegment, 3> sides_of_a, sides_of_b;
};

using TriangleCorners = std::array<Vec3d, 3>;

// Neither is degenerate. Exact.
[[nodiscard]] TriangleMeeting meet_triangles(const TriangleCorners& a, const TriangleCorners& b);

}  // namespace meshrepair::internal
