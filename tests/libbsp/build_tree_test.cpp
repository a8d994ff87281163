// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>
#include <base/parallel.h>
#include <bsp/build_tree.h>
#include <bsp/tree_io.h>

#include "degenerate_soups.h"
#include "each_seed.h"
#include "shapes.h"
#include "trees.h"

namespace meshrepair {
namespace {

using namespace testing;

// Every child once, after its parent; one leaf more than there are nodes.
void expect_valid_structure(const Tree& tree) {
  ASSERT_EQ(tree.leaves.size(), tree.nodes.size() + 1);
  std::vector<int> node_seen(tree.nodes.size(), 0), leaf_seen(tree.leaves.size(), 0);
  const auto see = [&](TreeRef ref) {
    if (ref.is_leaf()) {
      ASSERT_LT(ref.leaf().index(), leaf_seen.size());
      ++leaf_seen[ref.leaf().index()];
    } else {
      ASSERT_LT(ref.node().index(), node_seen.size());
      ++node_seen[ref.node().index()];
    }
  };
  see(tree.root);
  for (NodeId n(0u); n < tree.nodes.end_id(); ++n.value) {
    for (const TreeRef child : tree.nodes[n].child) {
      see(child);
      EXPECT_TRUE(child.is_leaf() || n < child.node());
    }
  }
  EXPECT_EQ(std::count(node_seen.begin(), node_seen.end(), 1),
            static_cast<std::ptrdiff_t>(node_seen.size()));
  EXPECT_EQ(std::count(leaf_seen.begin(), leaf_seen.end(), 1),
            static_cast<std::ptrdiff_t>(leaf_seen.size()));
}

// A triangle is named at nodes of its plane only, at each of them once, and at one at least.
void expect_every_triangle_at_home(const Tree& tree) {
  std::vector<char> placed(tree.input.triangles.size(), 0);
  std::size_t listed = 0;
  for (const TreeNode& node : tree.nodes) {
    listed += node.triangle_count;
    const auto first = tree.node_triangles.begin() + node.first_triangle;
    std::vector<TriangleId> here(first, first + node.triangle_count);
    for (const TriangleId t : here) {
      EXPECT_EQ(tree.input.triangles[t].plane, node.plane);
      placed[t.index()] = 1;
    }
    std::sort(here.begin(), here.end());
    EXPECT_EQ(std::adjacent_find(here.begin(), here.end()), here.end());
  }
  EXPECT_EQ(listed, tree.node_triangles.size());
  EXPECT_EQ(std::count(placed.begin(), placed.end(), 0), 0);
}

// No plane twice on a way from the root: the second would cut nothing.
void expect_planes_once_on_each_path(const Tree& tree) {
  std::vector<std::pair<TreeRef, std::vector<PlaneId>>> stack = {{tree.root, {}}};
  while (!stack.empty()) {
    auto [ref, path] = std::move(stack.back());
    stack.pop_back();
    if (ref.is_leaf()) continue;
    const TreeNode& node = tree.nodes[ref.node()];
    EXPECT_EQ(std::find(path.begin(), path.end(), node.plane), path.end());
    path.push_back(node.plane);
    for (const TreeRef child : node.child) stack.emplace_back(child, path);
  }
}

TEST(BuildTree, InvariantsHoldForDegenerateSoups) {
  for (const SoupFamily& family : degenerate_families()) {
    for_each_seed(8, [&](std::uint64_t seed) {
      SCOPED_TRACE(family.name + " " + std::to_string(seed));
      BuildTreeReport report;
      const Tree tree = tree_of(family.make(seed), report);
      EXPECT_EQ(report.lost_fragments, 0u);
      EXPECT_EQ(report.nodes, tree.nodes.size());
      EXPECT_EQ(report.leaves, tree.leaves.size());
      EXPECT_EQ(report.fragments, tree.node_triangles.size());
      EXPECT_GE(report.depth, std::bit_width(report.nodes));
      expect_valid_structure(tree);
      expect_every_triangle_at_home(tree);
      expect_planes_once_on_each_path(tree);
    });
  }
}

TEST(BuildTree, InvariantsHoldWhateverTheOptions) {
  const TriangleSoup soup = random_soup(60, 1000, 5);
  for (const std::size_t spatial_above : {std::size_t{0}, std::size_t{8}, std::size_t{100000}}) {
    for (const std::size_t candidates : {std::size_t{1}, std::size_t{60}}) {
      BuildTreeOptions options;
      options.spatial_cut_above = spatial_above;
      options.candidates = candidates;
      options.judged_fragments = candidates;
      BuildTreeReport report;
      const Tree tree = tree_of(soup, report, options);
      EXPECT_EQ(report.lost_fragments, 0u);
      expect_valid_structure(tree);
      expect_every_triangle_at_home(tree);
    }
  }
}

TEST(BuildTree, SameSoupGivesTheSameTree) {
  for (const TriangleSoup& soup : {noisy_sphere(500, 0.1, 1), random_soup(80, 4, 2)}) {
    EXPECT_EQ(format_tree(tree_of(soup)), format_tree(tree_of(soup)));
  }
}

// Nodes, planes and the triangles at nodes: all but the triangles' own corners and windings.
void expect_same_partition(const Tree& a, const Tree& b) {
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  for (NodeId n(0u); n < a.nodes.end_id(); ++n.value) {
    ASSERT_EQ(a.nodes[n].plane, b.nodes[n].plane);
    ASSERT_EQ(a.nodes[n].child[0].bits(), b.nodes[n].child[0].bits());
    ASSERT_EQ(a.nodes[n].child[1].bits(), b.nodes[n].child[1].bits());
    ASSERT_EQ(a.nodes[n].first_triangle, b.nodes[n].first_triangle);
    ASSERT_EQ(a.nodes[n].triangle_count, b.nodes[n].triangle_count);
  }
  EXPECT_EQ(a.node_triangles, b.node_triangles);
  ASSERT_EQ(a.input.planes.size(), b.input.planes.size());
  for (PlaneId p(0u); p.index() < a.input.planes.size(); ++p.value) {
    EXPECT_TRUE(same_coefficients(a.input.planes[p], b.input.planes[p]));
  }
}

// Large enough to be built in parts, within parts.
TEST(BuildTree, TheNumberOfThreadsDoesNotMatter) {
  const TriangleSoup soup = noisy_sphere(140000, 0.002, 1);
  BuildTreeReport many_report, one_report;
  const Tree many = tree_of(soup, many_report);
  expect_valid_structure(many);
  expect_every_triangle_at_home(many);
  EXPECT_EQ(many_report.nodes, many.nodes.size());
  EXPECT_EQ(many_report.leaves, many.leaves.size());
  EXPECT_EQ(many_report.fragments, many.node_triangles.size());
  const ThreadLimit one(1);
  EXPECT_EQ(format_tree(tree_of(soup, one_report)), format_tree(many));
  EXPECT_EQ(one_report.depth, many_report.depth);
  EXPECT_EQ(one_report.spatial_cuts, many_report.spatial_cuts);
  EXPECT_EQ(one_report.edge_cuts, many_report.edge_cuts);
}

// As a walk from the root meets them that sees the front of each node first, so that cells beside
// each other are near each other in memory; but the sides of the box come first.
TEST(BuildTree, NodesStandInTheOrderOfAWalk) {
  const Tree tree = tree_of(noisy_sphere(20000, 0.005, 1));
  std::vector<TreeRef> stack = {tree.root};
  NodeId next(0u);
  std::uint32_t triangles = 0;
  while (!stack.empty()) {
    const TreeRef ref = stack.back();
    stack.pop_back();
    if (ref.is_leaf()) continue;
    ASSERT_EQ(ref.node(), next);
    ++next.value;
    const TreeNode& node = tree.nodes[ref.node()];
    ASSERT_EQ(node.first_triangle, triangles);
    triangles += node.triangle_count;
    stack.push_back(node.child[1]);
    stack.push_back(node.child[0]);
  }
  EXPECT_EQ(next, tree.nodes.end_id());
}

TEST(BuildTree, OrientationOfTrianglesDoesNotMatter) {
  std::vector<TriangleSoup> soups = {noisy_sphere(600, 0.15, 3), random_cubes(12, 4)};
  for (const SoupFamily& family : degenerate_families()) soups.push_back(family.make(6));
  for (const TriangleSoup& soup : soups) {
    for_each_seed(3, [&](std::uint64_t seed) {
      expect_same_partition(tree_of(soup), tree_of(with_some_flipped(soup, 0.5, seed)));
    });
  }
}

TEST(BuildTree, NothingIsOneLeaf) {
  BuildTreeReport report;
  const Tree tree = tree_of(TriangleSoup{}, report);
  EXPECT_TRUE(tree.root.is_leaf());
  EXPECT_EQ(tree.root.leaf(), LeafId(0u));
  EXPECT_EQ(tree.leaves.size(), 1u);
  EXPECT_EQ(report.depth, 0u);
  expect_valid_structure(tree);
}

TEST(BuildTree, CoincidentTrianglesShareOneNode) {
  TriangleSoup soup;
  for (int i = 0; i < 200; ++i) add_triangle(soup, {0, 0, 0}, {1.0 + i, 0, 0}, {0, 1.0 + i, 0});
  BuildTreeReport report;
  const Tree tree = tree_of(soup, report);
  // Spatial cuts may come first, but no plane other than the common one holds triangles.
  expect_every_triangle_at_home(tree);
  BuildTreeOptions no_spatial;
  no_spatial.spatial_cut_above = 1000;
  const Tree plain = tree_of(soup, report, no_spatial);
  // The sides of the bounding box, flat on one axis; its one plane there has all triangles.
  EXPECT_EQ(plain.nodes.size(), 5u);
  std::size_t nodes_with_triangles = 0;
  for (const TreeNode& node : plain.nodes) nodes_with_triangles += node.triangle_count > 0;
  EXPECT_EQ(nodes_with_triangles, 1u);
  EXPECT_EQ(plain.node_triangles.size(), 200u);
}

TriangleSoup convex_fan(std::uint32_t count) {
  TriangleSoup soup;
  soup.points.emplace_back(0, 0, 1);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double a = 2 * std::numbers::pi * i / count;
    soup.points.emplace_back(std::cos(a), std::sin(a), 0);
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    soup.triangles.push_back({0, 1 + i, 1 + (i + 1) % count});
  }
  return soup;
}

// A cone: the plane of each triangle has all others on one side, and every axis-parallel cut has
// the hub on one side and with it all triangles.
TEST(BuildTree, AVertexSharedByThousandsKeepsTheTreeShallow) {
  BuildTreeReport report;
  const Tree tree = tree_of(convex_fan(5000), report);
  EXPECT_EQ(report.lost_fragments, 0u);
  EXPECT_LT(report.depth, 200u);
  EXPECT_LT(report.nodes, 5u * 5000);
  expect_valid_structure(tree);
  expect_every_triangle_at_home(tree);
}

TEST(BuildTree, AConvexBodyKeepsTheTreeShallow) {
  BuildTreeReport report;
  const Tree tree = tree_of(sphere(20000), report);
  EXPECT_LT(report.depth, 200u);
  EXPECT_LT(report.nodes, 4 * tree.input.triangles.size());
  EXPECT_GT(report.spatial_cuts, 0u);
}

// Without spatial cuts a convex body's tree is a list, as deep as it has faces; nothing recurses.
TEST(BuildTree, DepthIsNotBoundedByTheStack) {
  BuildTreeOptions options;
  options.spatial_cut_above = ~std::size_t{0};
  BuildTreeReport report;
  const Tree tree = tree_of(convex_fan(6000), report, options);
  EXPECT_GT(report.depth, 2000u);
  expect_valid_structure(tree);
}

TEST(BuildTree, CancellingThrows) {
  class Impatient : public ProgressObserver {
   public:
    bool cancelled() override { return true; }
  };
  Impatient observer;
  BuildTreeOptions options;
  options.progress = &observer;
  BuildTreeReport report;
  EXPECT_THROW((void)tree_of(sphere(5000), report, options), Cancelled);
}

TEST(BuildTree, ProgressDoesNotGoBack) {
  class Watcher : public ProgressObserver {
   public:
    void advance(double share) override {
      EXPECT_GE(share, last_);
      EXPECT_LE(share, 1);
      last_ = share;
      ++calls_;
    }
    double last_ = 0;
    int calls_ = 0;
  };
  Watcher observer;
  BuildTreeOptions options;
  options.progress = &observer;
  for (const std::size_t triangles : {3000u, 40000u}) {
    observer.last_ = 0;
    observer.calls_ = 0;
    BuildTreeReport report;
    (void)tree_of(noisy_sphere(triangles, 0.005, 1), report, options);
    EXPECT_GT(observer.calls_, 1);
  }
}

}  // namespace
}  // namespace meshrepair
