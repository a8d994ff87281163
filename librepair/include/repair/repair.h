// SPDX-License-Identifier: MIT
// repair() makes the boundary of a solid of any soup of triangles, as one call or in its three
// steps.
//
// What comes back, where RepairReport::certify.passed():
//
//  1. Closed: each edge of the indexed mesh has two triangles.
//  2. Manifold: the triangles around each point are one fan. Where solids touch, points have equal
//     coordinates and different indices.
//  3. Oriented: triangles are counter-clockwise seen from outside, those around voids from inside
//     the void.
//  4. Free of self-intersections: no two triangles have more in common than corners and edges that
//     they share, and none is without area.
//
//     All four are tested exactly, last of all, on the coordinates as the file will have them:
//     CertifyOptions::precision and `welded` say which file that is.
//
// And always:
//
//  5. Deterministic: the same input and options give the same bits, on any number of threads.
//  6. Exact: no tolerance decides what is solid or what crosses, unless RepairOptions::predicates
//     are floating. The working grid has 2^26 steps over the bounding box.
//  7. Triangles keep their source: Surface::source says of each triangle in which one of the input
//     it lies. A triangle that nothing cuts comes out with its three corners, bit for bit, unless
//     the precision rounds them or certification has to move them. A soup that is the boundary of
//     a solid already comes out as it is.
//
// Caveats:
//
//  - That the result passes is not promised: new points are rounded when they are written, and
//    rounding may fold the surface beyond what can be mended. The best surface that was found comes
//    back, and RepairReport::certify counts what is left. Look at passed() before you rely on it.
//  - What was in a hole does not come back, and open sheets enclose nothing: they are dropped,
//    unless RepairOptions::thicken makes walls of them.
//  - Which solid is meant is a guess where the triangles do not tell: RepairReport::inside says how
//    it was decided.
//  - What is thinner than a step of the grid is lost. RepairReport::lost_area has the area of all
//    that bounds nothing.
//  - Time is about n log n in the triangles of the input and in the pieces into which they cut each
//    other, and memory grows with both. Where all triangles intersect each other, the pieces are
//    far more than the triangles: bound the time through RepairOptions::progress.
//
// Throws, all of base/error.h: NoSolidError where nothing is enclosed; InputError where a triangle
// refers to a point that is not there; UsageError, or ValueError where another mesh would allow it,
// for options out of range; OutputError where coordinates are beyond the precision; Cancelled where
// the observer says so; LimitError where threads or 32-bit numbers of parts run out; InternalError
// for a bug.
//
// Example: what a binary STL file will hold, certified for programs that join its points.
//
//   meshrepair::RepairOptions options;
//   options.certify.precision = meshrepair::Precision::float32;
//   options.certify.welded = true;
//   const meshrepair::RepairResult result = meshrepair::repair(soup, options);
//   if (!result.report.certify.passed()) throw std::runtime_error("not certified");
//   const meshrepair::TriangleSoup& solid = result.surface.mesh;
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <bsp/tree.h>
#include <extract/arrange.h>
#include <extract/surface.h>
#include <mesh/soup.h>
#include <repair/cell_graph.h>
#include <repair/repair_options.h>
#include <repair/repair_report.h>

namespace meshrepair {

struct RepairResult {
  Surface surface;
  RepairReport report;
};

// Soup to boundary of a solid.
[[nodiscard]] RepairResult repair(const TriangleSoup& soup, const RepairOptions& options = {});
// The same, leaving the report when it throws.
[[nodiscard]] Surface repair(const TriangleSoup& soup, const RepairOptions& options,
                             RepairReport& report);

// The soup as it is if it is the boundary of a solid, and no rule fills what is hollow.
[[nodiscard]] std::optional<Surface> keep_valid(const TriangleSoup& soup,
                                                const RepairOptions& options);

// The steps in a row give the same bytes as the one call, unless that spares the cells of what is
// valid, or nearly.
//
// Step 1: soup to tree, its leaves unknown. Throws NoSolidError when no triangle is left.
[[nodiscard]] Tree make_tree(const TriangleSoup& soup, const RepairOptions& options,
                             RepairReport& report);
// Step 2: labels the leaves. Throws NoSolidError when no leaf is solid.
void label_tree(Tree& tree, const RepairOptions& options, RepairReport& report);
// Step 3: labelled tree to mesh. Throws InputError when a leaf has no label, NoSolidError when none
// is solid.
[[nodiscard]] Surface extract_mesh(const Tree& tree, const RepairOptions& options,
                                   RepairReport& report);

// The same from the chambers of an arrangement of `soup`, those with a flag in `solid`: extracted,
// simplified and certified. Nothing where cells are needed for that: where faces nearly coincide,
// in rare cases in which solids touch, or where the result is to be certified and is not.
[[nodiscard]] std::optional<Surface> extract_mesh(const CleanSoup& soup,
                                                  const Arrangement& arrangement,
                                                  const std::vector<char>& solid,
                                                  const RepairOptions& options,
                                                  RepairReport& report);

// The same from the cells between the triangles of `soup`, those with a flag in what `solid` makes
// of their graph: always. Without triangles where none has.
using SolidCells = std::function<std::vector<char>(CellGraph& graph)>;
[[nodiscard]] Surface extract_mesh(CleanSoup soup, const SolidCells& solid,
                                   const RepairOptions& options, RepairReport& report);

}  // namespace meshrepair
