// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>
#include <utility>

#include <base/error.h>
#include <boolean/boolean.h>

#include "boolean_chambers.h"
#include "label_beside_triangles.h"
#include "operands.h"

namespace meshrepair {
namespace {

Tree empty_tree(const Grid& grid) {
  Tree tree;
  tree.input.grid = grid;
  tree.root = TreeRef(tree.leaves.push_back({Label::empty, 1}));
  return tree;
}

RepairOptions with_winding(const RepairOptions& options) {
  RepairOptions changed = options;
  changed.inside = {};
  changed.inside.rule = InsideRule::winding;
  changed.holes = {};
  return changed;
}

// On the grid of all operands.
Tree make_operand(const TriangleSoup& solid, std::size_t number, const Grid& grid,
                  const BooleanOptions& options, BooleanReport& report) {
  OperandReport& operand = report.operands[number];
  CleanSoup clean = internal::clean_operand(solid, number, grid, options, report);
  if (clean.triangles.empty()) return empty_tree(grid);
  CancelOnly quiet(options.repair.progress);
  const bool is_solid = internal::bounds_a_solid(clean, &quiet);
  BuildTreeOptions tree_options = options.repair.tree;
  tree_options.progress = options.repair.progress;
  Tree tree = build_tree(std::move(clean), tree_options, operand.tree);
  if (is_solid && internal::label_beside_triangles(tree)) return tree;
  RepairReport labels;
  RepairOptions label_options = with_winding(options.repair);
  // The merge relies on the labels being those of closed surfaces.
  label_options.predicates = Predicates::exact;
  label_options.progress = &quiet;
  try {
    label_tree(tree, label_options, labels);
  } catch (const NoSolidError&) {
    internal::throw_too_small(number, grid);
  }
  return tree;
}

bool may_spare_trees(const BooleanOptions& options) {
  return !options.by_trees && options.test == RegionTest::cells &&
         options.repair.predicates == Predicates::exact && !options.repair.check_cells;
}

void put_before(const RepairReport& before, RepairReport& report) {
  report.join_gaps = before.join_gaps;
  report.stages.insert(report.stages.begin(), before.stages.begin(), before.stages.end());
}

BooleanOptions without_gaps(const BooleanOptions& options) {
  BooleanOptions changed = options;
  changed.repair.join_gaps = {};
  return changed;
}

Tree merge_operands(std::span<const TriangleSoup> solids, SetOperation operation,
                    const BooleanOptions& options, BooleanReport& report) {
  report = {};
  const Grid grid = internal::grid_of(solids);
  report.operands.resize(solids.size());
  StageMeter meter(report.result.stages, options.repair.progress);
  meter.begin("operands");
  Tree result = make_operand(solids[0], 0, grid, options, report);
  std::size_t sources = solids[0].triangles.size();
  for (std::size_t i = 1; i < solids.size(); ++i) {
    meter.begin("operands");
    const Tree next = make_operand(solids[i], i, grid, options, report);
    meter.begin("merge");
    MergeOptions merge_options;
    merge_options.test = options.test;
    merge_options.sealed = true;
    merge_options.second_source = static_cast<std::uint32_t>(sources);
    merge_options.progress = options.repair.progress;
    result = merge_trees(result, next, operation, merge_options, report.merges.emplace_back());
    sources += solids[i].triangles.size();
  }
  return result;
}

bool has_solid(const Tree& tree) {
  return std::any_of(tree.leaves.begin(), tree.leaves.end(),
                     [](const Leaf& leaf) { return leaf.label == Label::solid; });
}

}  // namespace

Tree boolean_tree(std::span<const TriangleSoup> solids, SetOperation operation,
                  const BooleanOptions& options, BooleanReport& report) {
  RepairReport before;
  const auto joined = internal::join_operands(solids, options, before);
  Tree tree = merge_operands(joined ? joined->solids : solids, operation, options, report);
  if (joined) {
    for (Triangle& triangle : tree.input.triangles) {
      triangle.source = internal::given_source(*joined, triangle.source);
    }
  }
  put_before(before, report.result);
  return tree;
}

Surface boolean_surface(const Tree& tree, const BooleanOptions& options, BooleanReport& report) {
  if (!has_solid(tree)) return {};
  return extract_mesh(tree, with_winding(options.repair), report.result);
}

Surface boolean(std::span<const TriangleSoup> solids, SetOperation operation,
                const BooleanOptions& options, BooleanReport& report) {
  RepairReport before;
  if (const auto joined = internal::join_operands(solids, options, before)) {
    Surface surface = boolean(joined->solids, operation, without_gaps(options), report);
    for (std::uint32_t& t : surface.source) t = internal::given_source(*joined, t);
    put_before(before, report.result);
    return surface;
  }
  if (may_spare_trees(options)) {
    auto surface = internal::boolean_by_chambers(solids, operation, options, report);
    return surface ? std::move(*surface)
                   : internal::boolean_by_cells(solids, operation, options, report);
  }
  return boolean_surface(merge_operands(solids, operation, options, report), options, report);
}

}  // namespace meshrepair
