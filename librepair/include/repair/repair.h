// The whole pipeline, as one call and in its three steps. The steps in a row give the same bytes as
// the one call, unless that spares the cells of what is valid, or nearly.
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

// Soup to boundary of a solid. Throws NoSolidError when no triangle is left after cleaning, or when
// nothing is enclosed, OutputError when coordinates are beyond the precision asked for.
[[nodiscard]] RepairResult repair(const TriangleSoup& soup, const RepairOptions& options = {});
// The same, leaving the report when it throws.
[[nodiscard]] Surface repair(const TriangleSoup& soup, const RepairOptions& options,
                             RepairReport& report);

// The soup as it is if it is the boundary of a solid, and no rule fills what is hollow.
[[nodiscard]] std::optional<Surface> keep_valid(const TriangleSoup& soup,
                                                const RepairOptions& options);

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
