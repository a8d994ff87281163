#include "candidate_planes.h"

#include <algorithm>
#include <limits>

#include <bsp/predicates.h>

namespace meshrepair::internal {
namespace {

// Corners nearer to a plane than this many grid steps are taken to be on it. A choice of speed
// alone.
constexpr double kNear = 1e-3;

struct Tally {
  std::size_t cut = 0, front = 0, back = 0;
};

void judge(const FragmentPool& pool, const Fragment& f, const Plane& plane, Tally& tally) {
  bool front = false;
  bool back = false;
  const Corner* corner = pool.corners(f);
  for (std::uint32_t i = 0; i < f.count; ++i) {
    const double distance = signed_distance(corner[i].point.position, plane);
    front |= distance > kNear;
    back |= distance < -kNear;
  }
  if (front && back) {
    ++tally.cut;
  } else if (front) {
    ++tally.front;
  } else if (back) {
    ++tally.back;
  }
}

}  // namespace

PlaneId choose_fragment_plane(const FragmentPool& pool, std::span<const FragmentId> fragments,
                              const BuildTreeOptions& options) {
  const std::size_t count = fragments.size();
  const std::size_t offers = std::min(options.candidates, count);
  const std::size_t judged = std::min(options.judged_fragments, count);
  std::size_t best_cost = std::numeric_limits<std::size_t>::max();
  FragmentId best = fragments[0];
  if (count == 1) return pool[best].plane;
  for (std::size_t k = 0; k < offers; ++k) {
    const FragmentId id = fragments[k * count / offers];
    const PlaneId offered = pool[id].plane;
    Tally tally;
    for (std::size_t j = 0; j < judged; ++j) {
      const Fragment& f = pool[fragments[j * count / judged]];
      if (f.plane != offered) judge(pool, f, pool.planes()[offered], tally);
      if (options.split_weight * tally.cut > best_cost) break;  // lost already
    }
    const std::size_t imbalance =
        std::max(tally.front, tally.back) - std::min(tally.front, tally.back);
    const std::size_t cost = options.split_weight * tally.cut + imbalance;
    const bool tie_won = cost == best_cost && pool[id].triangle < pool[best].triangle;
    if (cost < best_cost || tie_won) {
      best_cost = cost;
      best = id;
    }
  }
  return pool[best].plane;
}

}  // namespace meshrepair::internal
