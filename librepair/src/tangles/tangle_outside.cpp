#include "tangle_outside.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <base/disjoint_sets.h>
#include <base/ids.h>
#include <exact/double_predicates.h>

namespace meshrepair::internal {
namespace {

// From so many cells, and so many triangles, infinity is looked for.
constexpr std::size_t kMostCells = 8;
constexpr std::size_t kMostTriangles = 256;

// How far before a triangle a place is taken, in grid steps, and how far behind it.
constexpr double kBefore = 0x1p-8;

// Beyond the outer box from anywhere in it, in grid steps.
constexpr double kFar = 8.0 * kGridRadius;

class OutsideFinder {
 public:
  OutsideFinder(const CellComplex& complex, CellGraph& graph, std::span<const char> beside,
                const Tangles& tangles, const TangleWinding& winding, TangleRays& rays,
                ProgressObserver* progress)
      : complex_(complex),
        graph_(graph),
        beside_(beside),
        tangles_(tangles),
        winding_(winding),
        rays_(rays),
        sets_(graph.cells() + tangles.patches),
        check_(progress) {}

  bool run() {
    connect();
    list_seekers();
    std::vector<Fate> fate(graph_.cells() + tangles_.patches, Fate::sealed);
    for (CellId c(0u); c.index() < graph_.cells(); ++c.value) {
      if (!is_empty(c)) continue;
      Fate& of_set = fate[sets_.root(c.value)];
      if (beside_[c.index()] != 0) of_set = std::max(of_set, Fate::unknown);
      if (graph_.unbounded(c)) of_set = Fate::outside;
    }
    list_members(fate);
    for (const CellId c : seekers_) {
      const std::uint32_t set = sets_.root(c.value);
      if (fate[set] == Fate::unknown && !sees_infinity(set)) return false;
      if (fate[set] == Fate::unknown) fate[set] = Fate::outside;
    }
    for (const CellId c : seekers_) {
      if (fate[sets_.root(c.value)] == Fate::outside) graph_.set_unbounded(c);
    }
    return true;
  }

 private:
  // Of a set of empty cells: sealed if all cells around it are known.
  enum class Fate : std::uint8_t { sealed, unknown, outside };

  // A set, and what is in it.
  using Member = std::pair<std::uint32_t, std::uint32_t>;

  static std::span<const Member> members_of(std::uint32_t set, const std::vector<Member>& all) {
    const auto first = std::lower_bound(all.begin(), all.end(), Member{set, 0});
    const auto last = std::lower_bound(first, all.end(), Member{set + 1, 0});
    return std::span(all).subspan(static_cast<std::size_t>(first - all.begin()),
                                  static_cast<std::size_t>(last - first));
  }

  [[nodiscard]] bool is_empty(CellId c) const { return winding_.of_cell[c.index()] == 0; }

  // Empty cells with each other, and with the patches whose empty sides they are on.
  void connect() {
    const auto cells = static_cast<std::uint32_t>(graph_.cells());
    for (const Link& link : graph_.links()) {
      if (is_empty(link.above) && is_empty(link.below)) {
        sets_.join(link.above.value, link.below.value);
      }
      if (!link.opaque() || tangles_.tangled[link.triangle.index()] != 0) continue;
      const std::uint32_t patch = cells + tangles_.patch_of[link.triangle.index()];
      if (is_empty(link.above)) sets_.join(patch, link.above.value);
      if (is_empty(link.below)) sets_.join(patch, link.below.value);
    }
  }

  // The empty cells next to negative ones.
  void list_seekers() {
    const auto is_negative = [&](CellId c) { return winding_.of_cell[c.index()] < 0; };
    for (const Link& link : graph_.links()) {
      if (is_empty(link.above) && is_negative(link.below)) seekers_.push_back(link.above);
      if (is_empty(link.below) && is_negative(link.above)) seekers_.push_back(link.below);
    }
  }

  // Of the sets that have to be looked at.
  void list_members(const std::vector<Fate>& fate) {
    std::vector<char> wanted(fate.size(), 0);
    for (const CellId c : seekers_) {
      const std::uint32_t set = sets_.root(c.value);
      if (fate[set] == Fate::unknown) wanted[set] = 1;
    }
    for (CellId c(0u); c.index() < graph_.cells(); ++c.value) {
      const std::uint32_t set = sets_.root(c.value);
      if (is_empty(c) && wanted[set] != 0) cells_.push_back({set, c.value});
    }
    const auto cells = static_cast<std::uint32_t>(graph_.cells());
    for (std::uint32_t t = 0; t < tangles_.patch_of.size(); ++t) {
      if (tangles_.tangled[t] != 0) continue;
      const std::uint32_t set = sets_.root(cells + tangles_.patch_of[t]);
      if (wanted[set] != 0) triangles_.push_back({set, t});
    }
    std::sort(cells_.begin(), cells_.end());
    std::sort(triangles_.begin(), triangles_.end());
  }

  bool sees_infinity(std::uint32_t set) {
    std::vector<CellId> cells;
    for (const Member& m : members_of(set, cells_)) cells.emplace_back(m.second);
    for (const CellId c : largest_cells(graph_, beside_, std::move(cells), kMostCells)) {
      const std::optional<Vec3d> place = place_in(complex_, c);
      if (place && sees_infinity(*place)) return true;
    }
    const std::span<const Member> triangles = members_of(set, triangles_);
    const std::size_t step = triangles.size() / kMostTriangles + 1;
    for (std::size_t i = 0; i < triangles.size(); i += step) {
      const std::optional<Vec3d> place = place_before(triangles[i].second);
      if (place && sees_infinity(*place)) return true;
    }
    return false;
  }

  // On the empty side of a triangle, and certainly so near that nothing is between.
  std::optional<Vec3d> place_before(std::uint32_t t) {
    const auto& corners = tangles_.on_grid.triangles[t];
    const Vec3d& a = tangles_.on_grid.points[corners[0]];
    const Vec3d& b = tangles_.on_grid.points[corners[1]];
    const Vec3d& c = tangles_.on_grid.points[corners[2]];
    const bool front_is_empty = winding_.in_front[tangles_.patch_of[t]] == 0;
    const int side = (tangles_.winding[t] > 0) == front_is_empty ? 1 : -1;
    const Vec3d middle = (a + b + c) / 3;
    const Vec3d step = kBefore * side * (b - a).cross(c - a).normalized();
    const Vec3d before = middle + step, behind = middle - step;
    if (orientation(a, b, c, before) != side || orientation(a, b, c, behind) != -side) {
      return std::nullopt;
    }
    for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      if (orientation(before, behind, p, q) != orientation(before, behind, a, b)) {
        return std::nullopt;
      }
    }
    if (orientation(before, behind, a, b) == 0 || !rays_.get().sees(before, behind, t)) {
      return std::nullopt;
    }
    return before;
  }

  bool sees_infinity(const Vec3d& place) {
    check_.tick();
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
          if (x == 0 && y == 0 && z == 0) continue;
          if (rays_.get().sees(place, place + kFar * Vec3d(x, y, z))) return true;
        }
      }
    }
    return false;
  }

  const CellComplex& complex_;
  CellGraph& graph_;
  std::span<const char> beside_;
  const Tangles& tangles_;
  const TangleWinding& winding_;
  TangleRays& rays_;
  DisjointSets sets_;  // of the cells, then of the patches
  std::vector<CellId> seekers_;
  std::vector<Member> cells_, triangles_;  // by their sets
  CancelCheck check_;
};

}  // namespace

bool mark_outside(const CellComplex& complex, CellGraph& graph, std::span<const char> beside,
                  const Tangles& tangles, const TangleWinding& winding, TangleRays& rays,
                  ProgressObserver* progress) {
  return OutsideFinder(complex, graph, beside, tangles, winding, rays, progress).run();
}

}  // namespace meshrepair::internal
