// The cells around tangles fall into groups that are not linked, as what lies between them is left
// undivided. A group that reaches infinity starts from 0, any other from a ray. A patch has the
// winding numbers of the cells beside it; one that no group touches, a closed surface that nothing
// meets, those that a ray finds.
#include "tangle_winding.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <exact/predicates.h>

namespace meshrepair::internal {
namespace {

// So many places are tried for a ray, of the largest cells; one is enough but for slivers.
constexpr std::size_t kMostPlaces = 64;

class WindingWalk {
 public:
  WindingWalk(const CellComplex& complex, const CellGraph& graph, std::span<const char> beside,
              const Tangles& tangles, const Orientation& orientation, TangleRays& rays,
              ProgressObserver* progress)
      : complex_(complex),
        graph_(graph),
        beside_(beside),
        tangles_(tangles),
        orientation_(orientation),
        rays_(rays),
        check_(progress),
        reached_(graph.cells(), 0) {
    result_.of_cell.assign(graph.cells(), 0);
    result_.in_front.assign(tangles.patches, 0);
    result_.patch_has_cells.assign(tangles.patches, 0);
  }

  std::optional<TangleWinding> run() {
    walk_from_infinity();
    for (CellId c(0u); c.index() < graph_.cells(); ++c.value) {
      if (reached_[c.index()] == 0 && !graph_.links_of(c).empty() && !walk_from_ray(c)) {
        return std::nullopt;
      }
    }
    if (!is_consistent() || !look_beside_patches() || !look_at_patches_alone()) {
      return std::nullopt;
    }
    return std::move(result_);
  }

 private:
  void walk_from_infinity() {
    std::vector<CellId> queue;
    for (CellId c(0u); c.index() < graph_.cells(); ++c.value) {
      if (!graph_.unbounded(c)) continue;
      reached_[c.index()] = 1;
      queue.push_back(c);
    }
    walk(queue);
  }

  // On from cells that are reached; these and all that they reach are in `queue` then.
  void walk(std::vector<CellId>& queue) {
    for (std::size_t i = 0; i < queue.size(); ++i) {
      check_.tick();
      const CellId cell = queue[i];
      for (const std::uint32_t l : graph_.links_of(cell)) {
        const Link& link = graph_.links()[l];
        const CellId next = other_end(link, cell);
        if (reached_[next.index()] != 0) continue;
        reached_[next.index()] = 1;
        result_.of_cell[next.index()] =
            result_.of_cell[cell.index()] + (cell == link.above ? link.winding : -link.winding);
        queue.push_back(next);
      }
    }
  }

  // The group of a cell, relative to it first.
  bool walk_from_ray(CellId first) {
    reached_[first.index()] = 1;
    std::vector<CellId> group = {first};
    walk(group);
    for (const CellId c : largest_cells(graph_, beside_, group, kMostPlaces)) {
      check_.tick();
      const std::optional<Vec3d> place = place_in(complex_, c);
      if (!place) continue;
      const double missing = rays_.get().winding_at(*place) - result_.of_cell[c.index()];
      for (const CellId d : group) result_.of_cell[d.index()] += missing;
      return true;
    }
    return false;
  }

  [[nodiscard]] bool is_consistent() const {
    const auto& w = result_.of_cell;
    return std::all_of(graph_.links().begin(), graph_.links().end(), [&](const Link& link) {
      return w[link.below.index()] - w[link.above.index()] == link.winding;
    });
  }

  // Whether all cells beside a patch agree.
  bool look_beside_patches() {
    for (const Link& link : graph_.links()) {
      if (!link.opaque() || tangles_.tangled[link.triangle.index()] != 0) continue;
      const std::uint32_t patch = tangles_.patch_of[link.triangle.index()];
      const bool up = orientation_.winding[link.triangle] > 0;
      const double found = result_.of_cell[(up ? link.above : link.below).index()];
      std::int32_t& known = result_.in_front[patch];
      if (result_.patch_has_cells[patch] != 0 && known != found) return false;
      known = static_cast<std::int32_t>(found);
      result_.patch_has_cells[patch] = 1;
    }
    return true;
  }

  bool look_at_patches_alone() {
    std::vector<char> known = result_.patch_has_cells;
    for (std::uint32_t t = 0; t < tangles_.patch_of.size(); ++t) {
      const std::uint32_t patch = tangles_.patch_of[t];
      if (patch == kNone || known[patch] != 0) continue;
      check_.tick();
      const std::optional<std::int32_t> above = rays_.get().winding_above(t);
      if (!above) continue;
      const bool faces_up = rays_.get().facing(t) * tangles_.winding[t] > 0;
      result_.in_front[patch] = faces_up ? *above : *above - 1;
      known[patch] = 1;
    }
    return std::find(known.begin(), known.end(), 0) == known.end();
  }

  const CellComplex& complex_;
  const CellGraph& graph_;
  std::span<const char> beside_;
  const Tangles& tangles_;
  const Orientation& orientation_;
  TangleRays& rays_;
  CancelCheck check_;
  std::vector<char> reached_;
  TangleWinding result_;
};

}  // namespace

const SoupRays& TangleRays::get() {
  if (!rays_) rays_.emplace(tangles_.on_grid, tangles_.winding);
  return *rays_;
}

std::optional<Vec3d> place_in(const CellComplex& complex, CellId cell) {
  std::array<double, 3> sum{};
  double count = 0;
  complex.for_each_facet(cell, [&](FacetId f) {
    complex.for_each_use(f, [&](UseId u) {
      const auto& at = complex.vertices[complex.origin(complex.uses[u])].position;
      for (std::size_t k = 0; k < 3; ++k) sum[k] += at[k];
      ++count;
    });
  });
  for (double& x : sum) x /= count;
  bool inside = true;
  complex.for_each_facet(cell, [&](FacetId f) {
    const Facet& facet = complex.facets[f];
    const double distance = signed_distance(sum, complex.planes[facet.plane]);
    inside &= (facet.above == cell ? distance : -distance) > kDistanceError;
  });
  if (!inside) return std::nullopt;
  return Vec3d(sum[0], sum[1], sum[2]);
}

std::optional<TangleWinding> find_tangle_winding(const CellComplex& complex, const CellGraph& graph,
                                                 std::span<const char> beside,
                                                 const Tangles& tangles,
                                                 const Orientation& orientation, TangleRays& rays,
                                                 ProgressObserver* progress) {
  return WindingWalk(complex, graph, beside, tangles, orientation, rays, progress).run();
}

std::vector<CellId> largest_cells(const CellGraph& graph, std::span<const char> beside,
                                  std::vector<CellId> cells, std::size_t most) {
  // The volume is not known where links are missing.
  const auto size = [&](CellId c) { return beside[c.index()] != 0 ? 0 : graph.volume(c); };
  const std::size_t kept = std::min(most, cells.size());
  std::partial_sort(cells.begin(), cells.begin() + static_cast<long>(kept), cells.end(),
                    [&](CellId a, CellId b) {
                      return size(a) != size(b) ? size(a) > size(b) : a.value < b.value;
                    });
  cells.resize(kept);
  return cells;
}

}  // namespace meshrepair::internal
