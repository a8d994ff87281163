// SPDX-License-Identifier: MIT
#include "common/minimum_cut.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "each_seed.h"
#include "random_geometry.h"

namespace meshrepair::internal {
namespace {

using testing::Random;

struct Problem {
  std::vector<CutNode> nodes;
  std::vector<CutEdge> edges;
};

std::int64_t cost_of(const Problem& problem, std::uint32_t set) {
  const auto is_in = [&](std::size_t node) { return ((set >> node) & 1) != 0; };
  std::int64_t cost = 0;
  for (std::size_t n = 0; n < problem.nodes.size(); ++n) {
    cost += is_in(n) ? problem.nodes[n].in : problem.nodes[n].out;
  }
  for (const CutEdge& e : problem.edges) {
    if (is_in(e.from) != is_in(e.to)) cost += e.cost;
  }
  return cost;
}

// The nodes that are in all sets of least cost, which are such a set.
std::uint32_t least_set(const Problem& problem) {
  std::uint32_t common = 0;
  std::int64_t least = -1;
  for (std::uint32_t set = 0; set < std::uint32_t{1} << problem.nodes.size(); ++set) {
    const std::int64_t cost = cost_of(problem, set);
    if (least < 0 || cost < least) {
      least = cost;
      common = set;
    } else if (cost == least) {
      common &= set;
    }
  }
  EXPECT_EQ(cost_of(problem, common), least);
  return common;
}

std::uint32_t bits(const std::vector<char>& set) {
  std::uint32_t bits = 0;
  for (std::size_t n = 0; n < set.size(); ++n) {
    if (set[n] != 0) bits |= std::uint32_t{1} << n;
  }
  return bits;
}

// Costs are few, so that many sets cost the same; edges are double, and from nodes to themselves.
Problem random_problem(Random& random, int nodes, int highest) {
  Problem problem;
  for (int n = 0; n < nodes; ++n) {
    problem.nodes.push_back({random.integer(0, highest), random.integer(0, highest)});
  }
  for (int e = random.integer(0, 3 * nodes); e > 0; --e) {
    problem.edges.push_back({static_cast<std::uint32_t>(random.integer(0, nodes - 1)),
                             static_cast<std::uint32_t>(random.integer(0, nodes - 1)),
                             random.integer(0, highest)});
  }
  return problem;
}

TEST(MinimumCut, SmallestSetOfLeastCostIsFound) {
  for_each_seed(3000, [&](std::uint64_t seed) {
    Random random(seed);
    const Problem problem = random_problem(random, random.integer(1, 9), seed % 2 == 0 ? 3 : 1000);
    ASSERT_EQ(bits(minimum_cut(problem.nodes, problem.edges)), least_set(problem)) << seed;
  });
}

TEST(MinimumCut, ForbiddenEdgesAreNotCut) {
  for_each_seed(1000, [&](std::uint64_t seed) {
    Random random(seed);
    Problem problem = random_problem(random, 9, 10);
    problem.nodes[0] = {kForbidden, random.integer(0, 10)};
    problem.nodes[1] = {random.integer(0, 10), kForbidden};
    const std::uint32_t set = bits(minimum_cut(problem.nodes, problem.edges));
    ASSERT_EQ(set & 3, 2u) << seed;
    ASSERT_EQ(set, least_set(problem)) << seed;
  });
}

TEST(MinimumCut, ManyForbiddenNodesDoNotOverflow) {
  std::vector<CutNode> nodes;
  std::vector<CutEdge> edges;
  for (std::uint32_t n = 0; n < 100; ++n) {
    nodes.push_back(n % 2 == 0 ? CutNode{kForbidden, 0} : CutNode{0, kForbidden});
    if (n > 0) edges.push_back({n - 1, n, (kForbidden - 1) / 100});
  }
  const std::vector<char> set = minimum_cut(nodes, edges);
  for (std::uint32_t n = 0; n < 100; ++n) EXPECT_EQ(set[n] != 0, n % 2 != 0);
}

TEST(MinimumCut, OfNothingIsNothing) {
  EXPECT_TRUE(minimum_cut({}, {}).empty());
  const std::vector<CutNode> nodes(3);
  EXPECT_EQ(minimum_cut(nodes, {}), std::vector<char>(3, 0));
}

}  // namespace
}  // namespace meshrepair::internal
