// From outside, space is flooded by the widest ways first (Prim's algorithm, on cubes): so each
// place is come to by the way on which the narrowest place is as wide as can be. Where it is much
// wider than that, there is a space behind a neck, and all that is flooded from there on belongs to
// it. A grid tells necks of two to eight steps; so several are laid, each twice as fine as the one
// before.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include <base/ids.h>
#include <check/soup_rays.h>
#include <mesh/topology.h>
#include <repair/seal_openings.h>

#include "space_grid.h"

namespace meshrepair {
namespace {

using internal::SpaceGrid;

// In steps of the grid: how far from the surface distances are known, and how wide necks are.
constexpr double kReach = 12.5, kWidest = 8, kNarrowest = 2;
// Also in steps: the middle of the ball may be so far from that of a cube.
constexpr double kBesideMiddle = std::numbers::sqrt3 / 2;
constexpr double kWidening = 3;   // of the space behind a neck
constexpr double kCoarsest = 16;  // steps to the diagonal
constexpr double kSameVolume = 0.1;

class NeckFinder {
 public:
  NeckFinder(const SpaceGrid& grid, const SoupRays& rays)
      : grid_(grid), rays_(rays), is_done_(grid.nodes(), 0), necks_(1) {}

  std::vector<Neck> run(ProgressObserver* progress) {
    CancelCheck check(progress);
    waiting_.push({kReach * grid_.step(), grid_.outermost(), 0});
    while (!waiting_.empty()) {
      const Flooded next = waiting_.top();
      waiting_.pop();
      check.tick();
      if (is_done_[next.node] == 0) flood(next);
    }
    // What lies behind a neck lies behind the one before it.
    for (std::size_t n = necks_.size(); n-- > 1;) necks_[before_[n]].volume += necks_[n].volume;
    return {necks_.begin() + 1, necks_.end()};
  }

 private:
  struct Flooded {
    double width;  // half of it, of the narrowest place on the way
    std::uint32_t node, neck;
    bool operator<(const Flooded& other) const {
      return width != other.width ? width < other.width : node > other.node;
    }
  };

  void flood(Flooded from) {
    is_done_[from.node] = 1;
    const double clearance = std::min(grid_.clearance(from.node), kReach * grid_.step());
    const bool is_wide = clearance >= kWidening * from.width;
    if (is_wide && (from.neck == 0 || 2 * from.width < 0.9 * necks_[from.neck].width)) {
      before_.resize(necks_.size(), 0);
      before_.push_back(from.neck);
      from.neck = static_cast<std::uint32_t>(necks_.size());
      necks_.push_back({2 * from.width, 2 * kBesideMiddle * grid_.step(), 0});
    }
    necks_[from.neck].volume += volume_of(from.node);
    grid_.visit_neighbours(from.node, [&](std::uint32_t next) {
      if (is_done_[next] != 0 || !is_free(from.node, next)) return;
      waiting_.push({std::min(from.width, grid_.clearance(next)), next, from.neck});
    });
  }

  [[nodiscard]] bool is_free(std::uint32_t a, std::uint32_t b) const {
    return !grid_.is_cube(a) || !grid_.is_cube(b) || is_free_way(grid_, rays_, a, b);
  }

  [[nodiscard]] double volume_of(std::uint32_t node) const {
    const double side = grid_.step() * (grid_.is_cube(node) ? 1 : SpaceGrid::kBrick);
    return side * side * side;
  }

  const SpaceGrid& grid_;
  const SoupRays& rays_;
  std::vector<char> is_done_;
  std::priority_queue<Flooded> waiting_;
  std::vector<Neck> necks_;  // the first one stands for outside
  std::vector<std::uint32_t> before_ = {0};
};

double diagonal_of(const TriangleSoup& soup) {
  Vec3d low = soup.points.front(), high = low;
  for (const Vec3d& p : soup.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

// A neck that a grid has told, told better by a finer one.
bool is_same(const Neck& coarse, const Neck& fine) {
  return coarse.width <= fine.width + fine.error && fine.width <= coarse.width + coarse.error &&
         std::abs(coarse.volume - fine.volume) <= kSameVolume * fine.volume;
}

}  // namespace

std::vector<Neck> find_necks(const TriangleSoup& solid, double least_share, std::size_t most_cubes,
                             ProgressObserver* progress) {
  std::vector<Neck> all;
  if (solid.triangles.empty()) return all;
  const double diagonal = diagonal_of(solid), volume = signed_volume(solid);
  const std::vector<std::int32_t> no_winding(solid.triangles.size(), 0);
  const SoupRays rays(solid, no_winding);
  for (double step = diagonal / kCoarsest;; step /= 2) {
    SpaceGrid grid(solid, step, kReach * step, progress);
    if (grid.cubes() > most_cubes) break;
    grid.measure(progress);
    for (const Neck& neck : NeckFinder(grid, rays).run(progress)) {
      if (neck.width <= kNarrowest * step || neck.width > kWidest * step) continue;
      if (neck.volume < least_share * volume) continue;
      std::erase_if(all, [&](const Neck& coarse) { return is_same(coarse, neck); });
      all.push_back(neck);
    }
  }
  std::sort(all.begin(), all.end(), [](const Neck& a, const Neck& b) { return a.width < b.width; });
  return all;
}

}  // namespace meshrepair
