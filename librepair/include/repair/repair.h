// The whole pipeline, as one call and in its three steps. The steps in a row give the same bytes as
// the one call, unless that spares the cells of what is valid, or nearly.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include <bsp/build_tree.h>
#include <bsp/clean_soup.h>
#include <bsp/progress.h>
#include <bsp/soup.h>
#include <bsp/topology.h>
#include <bsp/tree.h>
#include <extract/clip_cell.h>
#include <extract/cover_facets.h>
#include <extract/extract_surface.h>
#include <extract/float_engine.h>
#include <extract/simplify_cuts.h>
#include <extract/surface.h>
#include <repair/certify.h>
#include <repair/hole_patches.h>
#include <repair/inside_rule.h>
#include <repair/orient_parts.h>
#include <repair/part_fates.h>
#include <repair/stage_meter.h>
#include <repair/thin_cells.h>

namespace meshrepair {

// Who says on which side of a plane a point of the cells lies. The rest is exact in either case:
// the working grid, the tree, the certificate.
enum class Predicates { exact, floating };

[[nodiscard]] std::string_view predicates_name(Predicates predicates);

struct RepairReport;

struct RepairOptions {
  Predicates predicates = Predicates::exact;
  // Of floating predicates: points within it are on a plane; relative to the largest side of the
  // input's bounding box. Their results are certified, but not mended by repairing them again.
  double epsilon = kDefaultEpsilon;
  // How sure it is that each triangle of the soup is part of the surface, above 0 and up to 1: for
  // the solidity. Empty: all are.
  std::vector<float> opacity;
  HoleOptions holes;
  BuildTreeOptions tree;
  InsideOptions inside;
  ExtractOptions extract;
  // How far the surface may move to have fewer triangles where it was cut, as a share of the
  // diagonal of its bounding box: see simplify_cuts(). 0: not at all.
  double simplify = 0;
  // Slits and fins thinner than two steps of the working grid are filled and dropped where
  // triangles are cut; in single precision also those thinner than so many steps of its numbers, as
  // their sheets would cross once they are written, and wider ones, up to 16 times, where few
  // faults are left else. 0: none are, in either precision.
  double slit_steps = 4;
  CertifyOptions certify;
  // Told what the result will be, but for what certification moves, which may take much longer than
  // all before; what it throws ends the work.
  std::function<void(const RepairReport&)> examine;
  // Leave a soup that is the boundary of a solid as it is, and make no cells where cleaning,
  // closing holes and turning parts makes one of it (valid_solid.h), unless another option asks for
  // more: the work for that is a small part of that of a repair.
  bool keep_valid = false;
  // Prove every invariant of the complex as it grows: a debugging aid, very slow.
  bool check_cells = false;
  ProgressObserver* progress = nullptr;
};

// What the programs that repair a mesh take for RepairOptions::simplify.
inline constexpr double kDefaultSimplify = 5e-7;

// Filled as far as the work came, also when it ended with an exception.
struct RepairReport {
  bool kept_valid = false;    // nothing was wrong, and the rest of the work was not done
  bool spared_cells = false;  // cleaned, closed and turned it was a solid: all about cells is 0
  // Triangles that meet no others: no cells were made of them; 0 also where cells are of all.
  std::size_t set_aside = 0;
  CleanReport clean;
  Topology input;         // of the clean soup
  double input_area = 0;  // of the clean soup, in the input's units, squared
  HoleReport holes;
  BuildTreeReport tree;
  Predicates predicates = Predicates::exact;  // and, if they are not exact, their epsilon
  double epsilon = 0;
  std::size_t cells = 0;
  std::size_t facets = 0;
  ClipReport clip;
  CoverReport cover;
  OrientReport orient;
  std::size_t links = 0;
  InsideReport inside;
  // Solid but that only open sheets were around it, flat but for rounding, or hardly more than what
  // was uncovered: made empty.
  std::size_t open_regions = 0;
  PartFates parts;
  ExtractReport extract;
  ThinCellsReport thin_cells;                // changed, as they are thinner than what numbers tell
  Precision precision = Precision::float64;  // for which they were too thin
  double slits_area = 0;    // of the surface that went with those filled, in the input's units
  double fins_area = 0;     // the same of those emptied
  std::size_t crumbs = 0;   // parts of cut pieces alone, thinner than a step of the grid: dropped
  SimplifyReport simplify;  // of the whole surface, not of what certification repairs again
  CertifyReport certify;
  TriangleFates triangles;
  Topology output;
  double output_volume = 0;  // in the input's units, cubed
  double output_area = 0;
  double closing_area = 0;  // of this, what no triangle of the input covers
  std::vector<StageReport> stages;
};

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

}  // namespace meshrepair
