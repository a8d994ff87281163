// SPDX-License-Identifier: MIT
// What a repair found, decided and did.
#pragma once

#include <cstddef>
#include <vector>

#include <base/stage_meter.h>
#include <bsp/build_tree.h>
#include <bsp/clean_soup.h>
#include <extract/arrange.h>
#include <extract/clip_cell.h>
#include <extract/cover_facets.h>
#include <extract/extract_surface.h>
#include <extract/predicate_engine.h>
#include <extract/simplify_cuts.h>
#include <mesh/precision.h>
#include <mesh/topology.h>
#include <repair/certify.h>
#include <repair/explain_repair.h>
#include <repair/fewer_triangles.h>
#include <repair/hole_patches.h>
#include <repair/inside_rule.h>
#include <repair/join_gaps.h>
#include <repair/keep_parts.h>
#include <repair/orient_parts.h>
#include <repair/part_fates.h>
#include <repair/seal_openings.h>
#include <repair/sew_soup.h>
#include <repair/thicken_sheets.h>
#include <repair/thin_cells.h>

namespace meshrepair {

// Filled as far as the work came, also when it ended with an exception.
struct RepairReport {
  bool kept_valid = false;    // nothing was wrong, and the rest of the work was not done
  bool spared_cells = false;  // cleaned, closed and turned it was a solid: all about cells is 0
  CleanReport clean;
  Topology input;         // of the clean soup
  double input_area = 0;  // of the clean soup, in the input's units, squared
  // The same of its volume as its triangles face: an estimate where they are not closed.
  double input_volume = 0;
  JoinGapsReport join_gaps;
  SewReport sew;
  HoleReport holes;
  SealReport seal;
  ThickenReport thicken;
  BuildTreeReport tree;
  Predicates predicates = Predicates::exact;  // and, if they are not exact, their epsilon
  double epsilon = 0;
  ArrangeReport arrange;  // all 0 where cells were made
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
  // Of input_area, what bounds nothing and is not inside the solid: pieces with nothing solid on
  // either side, and not made walls.
  double lost_area = 0;
  ExtractReport extract;
  ThinCellsReport thin_cells;                // changed, as they are thinner than what numbers tell
  Precision precision = Precision::float64;  // for which they were too thin
  double slits_area = 0;    // of the surface that went with those filled, in the input's units
  double fins_area = 0;     // the same of those emptied
  std::size_t crumbs = 0;   // parts of cut pieces alone, thinner than a step of the grid: dropped
  SimplifyReport simplify;  // of the whole surface, not of what certification repairs again
  CertifyReport certify;
  KeepPartsReport keep;
  FewerTrianglesReport fewer;
  TriangleFates triangles;
  // The result has the triangles of the soup, facing as they did there, and no others; maybe with
  // corners rounded to single precision.
  bool same_triangles = false;
  RepairExplanation explanation;  // empty unless it is asked for
  Topology output;
  double output_volume = 0;  // in the input's units, cubed
  double output_area = 0;
  double closing_area = 0;  // of this, what no triangle of the input covers
  std::vector<StageReport> stages;
};

}  // namespace meshrepair
