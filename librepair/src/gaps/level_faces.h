// Flat faces that are near each other come to lie in one plane.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <check/near_faces.h>
#include <mesh/edge_table.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

// Where the points are to be: in the planes of the largest triangle of all that are near each other
// or go on from each other, as far as these are within the distance of its plane; where they are
// where several such planes meet no point farther than the radius, they stay. `corners` are those of
// the soup, by the first points in their places.
[[nodiscard]] std::vector<Vec3d> level_faces(const TriangleSoup& soup,
                                             std::span<const IndexTriangle> corners,
                                             std::span<const NearFaces> pairs, double distance,
                                             double radius);

}  // namespace meshrepair::internal
