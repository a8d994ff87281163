// SPDX-License-Identifier: MIT
// What can be asked of a repair.
#pragma once

#include <functional>
#include <vector>

#include <base/progress.h>
#include <base/state_store.h>
#include <bsp/build_tree.h>
#include <extract/extract_surface.h>
#include <extract/float_engine.h>
#include <extract/predicate_engine.h>
#include <repair/certify.h>
#include <repair/fewer_triangles.h>
#include <repair/hole_patches.h>
#include <repair/inside_rule.h>
#include <repair/join_gaps.h>
#include <repair/keep_parts.h>
#include <repair/seal_openings.h>
#include <repair/sew_soup.h>
#include <repair/thicken_sheets.h>

namespace meshrepair {

struct RepairReport;

// Of RepairOptions::simplify.
inline constexpr double kDefaultSimplify = 5e-7;

// What nobody sets is what the programs do.
struct RepairOptions {
  Predicates predicates = Predicates::exact;
  // Of floating predicates: points within it are on a plane; relative to the largest side of the
  // input's bounding box. Their results are certified, but not mended by repairing them again.
  double epsilon = kDefaultEpsilon;
  // How sure it is that each triangle of the soup is part of the surface, above 0 and up to 1: for
  // the solidity, where it is asked for. Empty: all are.
  std::vector<float> opacity;
  JoinGapsOptions join_gaps;
  SewOptions sew;
  HoleOptions holes;
  SealOptions seal;
  // Open sheets, which enclose nothing: what of them is to become walls. What `holes` leaves open
  // is a sheet then, unless it is to be extended.
  ThickenOptions thicken;
  BuildTreeOptions tree;
  InsideOptions inside;
  ExtractOptions extract;
  KeepPartsOptions keep;  // which solids of the result stay
  // Last of all: how many triangles the result may have.
  FewerTrianglesOptions fewer;
  // How far the surface may move to have fewer triangles where it was cut, as a share of the
  // diagonal of its bounding box: see simplify_cuts(). 0: not at all.
  double simplify = kDefaultSimplify;
  // Of each triangle of the soup, SimplifyOptions::reach, where triangles carry more than their
  // places: keep_attributes() finds it. Empty: they do not.
  std::vector<double> reach;
  // Slits and fins thinner than two steps of the working grid are filled and dropped where
  // triangles are cut; in single precision also those thinner than so many steps of its numbers, as
  // their faces would cross once they are written, and wider ones, up to 16 times, where few
  // faults are left else. 0: none are, in either precision.
  double slit_steps = 4;
  CertifyOptions certify;
  // Told what the result will be, but for what certification moves, which may take much longer than
  // all before; what it throws ends the work.
  std::function<void(const RepairReport&)> examine;
  // Divide all space into cells, whatever the soup is. Else cells are made where nothing that costs
  // less gives the same solid: a soup that is the boundary of a solid stays as it is, and so on
  // (repair.cpp).
  bool all_cells = false;
  // Fills RepairReport::explanation.
  bool explain = false;
  // Prove every invariant of the complex as it grows: a debugging aid, very slow.
  bool check_cells = false;
  // Where what is done is kept, for a run that goes on from there with the same options; not owned.
  // Null: nowhere. Nothing is kept of what follows repair(), nor where sheets become walls.
  StateStore* states = nullptr;
  ProgressObserver* progress = nullptr;
};

}  // namespace meshrepair
