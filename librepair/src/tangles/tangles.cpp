#include "tangles.h"

#include <algorithm>
#include <span>
#include <utility>

#include <base/disjoint_sets.h>
#include <base/ids.h>
#include <check/self_intersections.h>
#include <mesh/edge_table.h>
#include <repair/orient_parts.h>

#include "orient/surface_patches.h"

namespace meshrepair::internal {
namespace {

void find_patches(const EdgeTable& table, Tangles& tangles) {
  const std::vector<char>& tangled = tangles.tangled;
  tangles.count = static_cast<std::size_t>(std::count(tangled.begin(), tangled.end(), 1));
  DisjointSets sets(tangled.size());
  table.for_each_edge([&](std::span<const std::uint32_t> sides) {
    if (sides.size() != 2) return;
    const std::uint32_t a = sides[0] / 3, b = sides[1] / 3;
    if (tangled[a] == 0 && tangled[b] == 0) sets.join(a, b);
  });
  tangles.patches = 0;
  tangles.patch_of.assign(tangled.size(), kNone);
  for (std::uint32_t t = 0; t < tangled.size(); ++t) {
    if (tangled[t] != 0) continue;
    // The lowest triangle stands for its set, so it comes first.
    const std::uint32_t root = sets.root(t);
    tangles.patch_of[t] = root == t ? tangles.patches++ : tangles.patch_of[root];
  }
}

class TangleFinder {
 public:
  TangleFinder(const CleanSoup& soup, const IdVector<TriangleId, std::int32_t>& winding) {
    TriangleSoup& mesh = result_.on_grid;
    mesh.triangles = index_triangles(soup);
    for (const GridPoint& p : soup.grid_points) mesh.points.push_back(as_vector(p));
    for (TriangleId t(0u); t < soup.triangles.end_id(); ++t.value) {
      result_.winding.push_back(winding[t] * side_of_corners(soup, t));
    }
    result_.tangled.assign(mesh.triangles.size(), 0);
  }

  std::optional<Tangles> run(ProgressObserver* progress) {
    const EdgeTable table(result_.on_grid.triangles);
    if (!look_at_edges(table) || !look_at_pairs(progress)) return std::nullopt;
    find_patches(table, result_);
    return std::move(result_);
  }

 private:
  // How often the triangle of the side passes its edge towards the point with the higher index.
  [[nodiscard]] std::int32_t runs_up(std::uint32_t side) const {
    const auto& triangles = result_.on_grid.triangles;
    const bool up = side_start(triangles, side) < side_start(triangles, next_side(side));
    return up ? result_.winding[side / 3] : -result_.winding[side / 3];
  }

  // Whether the windings balance at all of them.
  bool look_at_edges(const EdgeTable& table) {
    bool balanced = true;
    table.for_each_edge([&](std::span<const std::uint32_t> sides) {
      std::int32_t sum = 0;
      for (const std::uint32_t s : sides) sum += runs_up(s);
      balanced = balanced && sum == 0;
      if (sides.size() == 2 && std::abs(runs_up(sides[0])) == 1) return;
      for (const std::uint32_t s : sides) result_.tangled[s / 3] = 1;
    });
    return balanced;
  }

  // Whether they are not too many.
  bool look_at_pairs(ProgressObserver* progress) {
    SelfIntersectionOptions options;
    options.weld = false;
    options.most_pairs = result_.tangled.size();
    options.progress = progress;
    const SelfIntersections found = self_intersections(result_.on_grid, options);
    for (const auto& pair : found.pairs) {
      for (const std::uint32_t t : pair) result_.tangled[t] = 1;
    }
    return found.pairs.size() == found.count;
  }

  Tangles result_;
};

}  // namespace

std::optional<Tangles> find_tangles(const CleanSoup& soup,
                                    const IdVector<TriangleId, std::int32_t>& winding,
                                    ProgressObserver* progress) {
  return TangleFinder(soup, winding).run(progress);
}

void add_tangled(std::span<const std::uint32_t> triangles, Tangles& tangles) {
  for (const std::uint32_t t : triangles) tangles.tangled[t] = 1;
  find_patches(EdgeTable(tangles.on_grid.triangles), tangles);
}

}  // namespace meshrepair::internal
