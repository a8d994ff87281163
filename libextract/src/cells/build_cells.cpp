// SPDX-License-Identifier: MIT
#include <string>
#include <utility>
#include <vector>

#include <base/error.h>
#include <extract/build_cells.h>

#include "check_complex.h"

namespace meshrepair {
namespace {

constexpr std::size_t kTicksPerProgress = 1024;

struct Visit {
  TreeRef ref;
  CellId cell;
};

class CellBuilder {
 public:
  CellBuilder(const Tree& tree, const BuildCellsOptions& options)
      : tree_(tree),
        options_(options),
        complex_(tree.input, outer_box(tree.input)),
        engine_(options.engine != nullptr ? *options.engine : exact_),
        clipper_(complex_, engine_) {
    complex_.loose = !engine_.exact();
  }

  CellComplex run(ClipReport& report) {
    // Depth first: a cell is cut while its neighbourhood is still in the caches.
    std::vector<Visit> stack = {{tree_.root, CellId(0u)}};
    while (!stack.empty()) {
      const Visit visit = stack.back();
      stack.pop_back();
      if (visit.ref.is_leaf()) {
        complex_.cells[visit.cell].leaf = visit.ref.leaf();
        continue;
      }
      const TreeNode& node = tree_.nodes[visit.ref.node()];
      const CellId below = cut(visit.cell, node);
      stack.push_back({node.child[1], below});
      stack.push_back({node.child[0], visit.cell});
      tell_progress();
    }
    report = clipper_.report();
    return std::move(complex_);
  }

 private:
  CellId cut(CellId cell, const TreeNode& node) {
    const std::size_t fallbacks = clipper_.report().fallbacks();
    const CellId below = clipper_.clip(cell, node.plane);
    if (engine_.exact() && clipper_.report().fallbacks() != fallbacks) {
      throw InputError("the tree is not valid: the plane of node " +
                       std::to_string(&node - tree_.nodes.raw().data()) +
                       " does not cut its region");
    }
    hang_triangles(complex_.facets.end_id().value - 1, node);
    if (options_.check_every_clip) {
      internal::check_cell(complex_, cell);
      internal::check_cell(complex_, below);
    }
    return below;
  }

  // The triangles of the node ride on the facet that its plane has just made.
  void hang_triangles(std::uint32_t facet, const TreeNode& node) {
    if (node.triangle_count == 0) return;
    auto& pool = complex_.facet_triangles;
    Facet& f = complex_.facets[FacetId(facet)];
    f.first_triangle = begin_of_list(pool.size(), node.triangle_count);
    f.triangle_count = node.triangle_count;
    for (std::uint32_t i = 0; i < node.triangle_count; ++i) {
      pool.push_back(tree_.node_triangles[node.first_triangle + i]);
    }
  }

  void tell_progress() {
    if (options_.progress == nullptr || ++ticks_ % kTicksPerProgress != 0) return;
    if (options_.progress->cancelled()) throw Cancelled();
    options_.progress->advance(static_cast<double>(ticks_) /
                               static_cast<double>(tree_.nodes.size()));
  }

  const Tree& tree_;
  const BuildCellsOptions& options_;
  ExactEngine exact_;
  CellComplex complex_;
  PredicateEngine& engine_;
  Clipper clipper_;
  std::size_t ticks_ = 0;
};

}  // namespace

CellComplex build_cells(const Tree& tree, const BuildCellsOptions& options, ClipReport& report) {
  return CellBuilder(tree, options).run(report);
}

}  // namespace meshrepair
