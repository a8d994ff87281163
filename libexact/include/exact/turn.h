// Which way do three points of a plane turn?
//
// Properties: turn(a, b, c) is the sign of the triangle's area seen from where the plane's normal
// points, without error, for lattice points and points given by three planes. It stays when the
// points are rotated and changes sign when two of them change places. Loose points get the sign of
// their rounded area, or 0 where one is within its tolerance of the line through the others.
#pragma once

#include <exact/plane_table.h>
#include <exact/point.h>

namespace meshrepair {

// +1 counter-clockwise, -1 clockwise, 0 in a line. All three lie in `plane`.
[[nodiscard]] int turn(const Point& a, const Point& b, const Point& c, PlaneId plane,
                       const PlaneTable& planes);

}  // namespace meshrepair
