// SPDX-License-Identifier: MIT
#include "label_beside_triangles.h"

#include <array>
#include <utility>
#include <vector>

#include <check/check_surface.h>
#include <extract/clip_cell.h>

namespace meshrepair::internal {
namespace {

struct Parent {
  NodeId node;
  std::size_t side = 0;
};

// +1 where all triangles of the node face the way its plane does, -1 the other way, 0 where they
// disagree, or there are none.
int facing(const Tree& tree, const TreeNode& node) {
  int all = 0;
  for (std::uint32_t i = 0; i < node.triangle_count; ++i) {
    const TriangleId t = tree.node_triangles[node.first_triangle + i];
    const int winding = tree.input.triangles[t].winding;
    if (winding == 0 || winding == -all) return 0;
    all = winding;
  }
  return all;
}

IdVector<NodeId, Parent> parents_of(const Tree& tree) {
  IdVector<NodeId, Parent> parents;
  parents.resize(tree.nodes.size());
  for (NodeId n(0u); n < tree.nodes.end_id(); ++n.value) {
    for (const std::size_t side : {0u, 1u}) {
      const TreeRef child = tree.nodes[n].child[side];
      if (!child.is_leaf()) parents[child.node()] = {n, side};
    }
  }
  return parents;
}

// Of the child of a node: all of the input is inside the box that stands for space.
bool reaches_the_end_of_space(const Tree& tree, const IdVector<NodeId, Parent>& parents,
                              Parent way) {
  std::vector<Parent> ways;
  for (; way.node.valid(); way = parents[way.node]) ways.push_back(way);
  ExactEngine engine;
  CellComplex complex(tree.input, outer_box(tree.input));
  Clipper clipper(complex, engine);
  CellId cell(0u);
  for (auto step = ways.rbegin(); step != ways.rend(); ++step) {
    const CellId below = clipper.clip(cell, tree.nodes[step->node].plane);
    if (step->side == 1) cell = below;
  }
  bool found = false;
  complex.for_each_facet(cell, [&](FacetId f) {
    found |= !complex.facets[f].above.valid() || !complex.facets[f].below.valid();
  });
  return found;
}

}  // namespace

bool bounds_a_solid(const CleanSoup& soup, ProgressObserver* progress) {
  TriangleSoup on_grid;
  on_grid.points.reserve(soup.grid_points.size());
  for (const GridPoint& p : soup.grid_points) on_grid.points.emplace_back(p.x, p.y, p.z);
  on_grid.triangles.reserve(soup.triangles.size());
  for (const Triangle& t : soup.triangles) {
    if (t.winding == 0) return false;
    on_grid.triangles.push_back({t.corners[0].value, t.corners[1].value, t.corners[2].value});
  }
  CheckOptions options;
  options.most_places = 0;
  options.progress = progress;
  return check_surface(on_grid, options).valid_solid();
}

bool label_beside_triangles(Tree& tree) {
  // Each cuts its way from the root anew.
  constexpr std::size_t kMostSearches = 64;
  const IdVector<NodeId, Parent> parents = parents_of(tree);
  std::size_t searches = 0;
  for (NodeId n(0u); n < tree.nodes.end_id(); ++n.value) {
    const TreeNode& node = tree.nodes[n];
    const int faces = facing(tree, node);
    for (const std::size_t side : {0u, 1u}) {
      if (!node.child[side].is_leaf()) continue;
      Leaf& leaf = tree.leaves[node.child[side].leaf()];
      if (faces != 0) {
        const bool outside = (faces > 0) == (side == 0);
        leaf = {outside ? Label::empty : Label::solid, 1};
      } else if (node.triangle_count == 0 && ++searches <= kMostSearches &&
                 reaches_the_end_of_space(tree, parents, {n, side})) {
        leaf = {Label::empty, 1};
      } else {
        return false;
      }
    }
  }
  return tree.nodes.size() > 0;
}

}  // namespace meshrepair::internal
