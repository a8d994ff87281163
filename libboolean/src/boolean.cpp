#include <algorithm>
#include <sstream>
#include <string>
#include <utility>

#include <base/error.h>
#include <boolean/boolean.h>
#include <boolean/label_beside_triangles.h>
#include <bsp/common_grid.h>

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

[[noreturn]] void throw_too_small(std::size_t operand, const Grid& grid) {
  std::ostringstream message;
  message << "solid " << operand + 1
          << " is nothing beside the others: on the grid of 2^26 steps over all, of " << grid.unit
          << " each, it has no volume";
  throw InputError(message.str());
}

double volume_on_grid(const TriangleSoup& solid, const Grid& grid) {
  TriangleSoup rounded;
  rounded.triangles = solid.triangles;
  rounded.points.reserve(solid.points.size());
  for (const Vec3d& p : solid.points) rounded.points.push_back(as_vector(grid.to_grid(p)));
  return signed_volume(rounded) * grid.unit * grid.unit * grid.unit;
}

// On the grid of all operands.
Tree make_operand(const TriangleSoup& solid, std::size_t number, const Grid& grid,
                  const BooleanOptions& options, BooleanReport& report) {
  OperandReport& operand = report.operands[number];
  operand.volume = signed_volume(solid);
  if (solid.triangles.empty()) return empty_tree(grid);
  CleanSoup clean = clean_soup(solid, grid, operand.clean, options.repair.progress);
  if (clean.triangles.empty()) throw_too_small(number, grid);
  operand.volume_on_grid = volume_on_grid(solid, grid);
  CancelOnly quiet(options.repair.progress);
  const bool is_solid = bounds_a_solid(clean, &quiet);
  BuildTreeOptions tree_options = options.repair.tree;
  tree_options.progress = options.repair.progress;
  Tree tree = build_tree(std::move(clean), tree_options, operand.tree);
  if (is_solid && label_beside_triangles(tree)) return tree;
  RepairReport labels;
  RepairOptions label_options = with_winding(options.repair);
  // The merge relies on the labels being those of closed surfaces.
  label_options.predicates = Predicates::exact;
  label_options.progress = &quiet;
  try {
    label_tree(tree, label_options, labels);
  } catch (const NoSolidError&) {
    throw_too_small(number, grid);
  }
  return tree;
}

bool has_solid(const Tree& tree) {
  return std::any_of(tree.leaves.begin(), tree.leaves.end(),
                     [](const Leaf& leaf) { return leaf.label == Label::solid; });
}

}  // namespace

Tree boolean_tree(std::span<const TriangleSoup> solids, SetOperation operation,
                  const BooleanOptions& options, BooleanReport& report) {
  if (solids.empty()) throw InputError("there is no solid to begin with");
  report = {};
  report.operands.resize(solids.size());
  std::vector<const TriangleSoup*> all;
  all.reserve(solids.size());
  for (const TriangleSoup& solid : solids) all.push_back(&solid);
  const Grid grid = make_grid(all);
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

Surface boolean_surface(const Tree& tree, const BooleanOptions& options, BooleanReport& report) {
  if (!has_solid(tree)) return {};
  return extract_mesh(tree, with_winding(options.repair), report.result);
}

Surface boolean(std::span<const TriangleSoup> solids, SetOperation operation,
                const BooleanOptions& options, BooleanReport& report) {
  return boolean_surface(boolean_tree(solids, operation, options, report), options, report);
}

}  // namespace meshrepair
