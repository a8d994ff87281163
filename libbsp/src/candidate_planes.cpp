// SPDX-License-Identifier: MIT
#include "candidate_planes.h"

#include <algorithm>
#include <limits>

#include <exact/predicates.h>

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

// What a plane would cost, judged on a sample; more than `limit` once that is certain. Fragments in
// the plane `own` cost nothing.
std::size_t cost_of(const FragmentPool& pool, std::span<const FragmentId> fragments,
                    const Plane& plane, PlaneId own, const BuildTreeOptions& options,
                    std::size_t limit) {
  const std::size_t count = fragments.size();
  const std::size_t judged = std::min(options.judged_fragments, count);
  Tally tally;
  for (std::size_t j = 0; j < judged; ++j) {
    const Fragment& f = pool[fragments[j * count / judged]];
    if (f.plane != own) judge(pool, f, plane, tally);
    if (options.split_weight * tally.cut > limit) break;
  }
  return options.split_weight * tally.cut + std::max(tally.front, tally.back) -
         std::min(tally.front, tally.back);
}

// Offers the planes through an edge of each of two triangles with a corner in common, from that
// corner. Around the tip of a cone such a plane cuts no triangle, and its base only along a chord:
// chords between chords cross each triangle of the base a logarithmic number of times, radii would
// cross it linearly often.
template <class Offer>
void offer_planes_of_fan(const CleanSoup& soup, const Triangle& a, const Triangle& b, Offer offer) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (a.corners[i] != b.corners[j]) continue;
      const GridPoint& tip = soup.grid_points[a.corners[i]];
      for (std::size_t k = 1; k < 3; ++k) {
        for (std::size_t l = 1; l < 3; ++l) {
          offer(plane_through(tip, soup.grid_points[a.corners[(i + k) % 3]],
                              soup.grid_points[b.corners[(j + l) % 3]]));
        }
      }
    }
  }
}

}  // namespace

FragmentPlane choose_fragment_plane(const FragmentPool& pool, std::span<const FragmentId> fragments,
                                    const BuildTreeOptions& options) {
  const std::size_t count = fragments.size();
  const std::size_t offers = std::min(options.candidates, count);
  std::size_t best_cost = std::numeric_limits<std::size_t>::max();
  FragmentId best = fragments[0];
  if (count == 1) return {pool[best].plane, 0};
  for (std::size_t k = 0; k < offers; ++k) {
    const FragmentId id = fragments[k * count / offers];
    const PlaneId offered = pool[id].plane;
    const std::size_t cost =
        cost_of(pool, fragments, pool.planes()[offered], offered, options, best_cost);
    const bool tie_won = cost == best_cost && pool[id].triangle < pool[best].triangle;
    if (cost < best_cost || tie_won) {
      best_cost = cost;
      best = id;
    }
  }
  return {pool[best].plane, best_cost};
}

std::optional<Plane> choose_edge_plane(const FragmentPool& pool, const CleanSoup& soup,
                                       std::span<const FragmentId> fragments,
                                       const BuildTreeOptions& options, std::size_t to_beat) {
  const std::size_t count = fragments.size();
  const std::size_t offers = std::min(options.candidates, count);
  std::optional<Plane> best;
  const auto offer = [&](const Plane& offered) {
    if (is_null(offered)) return;
    const std::size_t cost = cost_of(pool, fragments, offered, PlaneId(), options, to_beat);
    const bool tie_won = best && cost == to_beat && comes_before(offered, *best);
    if (cost >= to_beat && !tie_won) return;
    to_beat = cost;
    best = offered;
  };
  const auto triangle_offering = [&](std::size_t k) -> const Triangle& {
    return soup.triangles[pool[fragments[k * count / offers]].triangle];
  };
  for (std::size_t k = 0; k < offers; ++k) {
    for (std::size_t j = 0; j < k; ++j) {
      offer_planes_of_fan(soup, triangle_offering(j), triangle_offering(k), offer);
    }
  }
  // A plane of a fan that cuts almost nothing needs no rival.
  if (best && to_beat <= std::min(options.judged_fragments, count) / 4) return best;
  for (std::size_t k = 0; k < offers; ++k) {
    const Triangle& triangle = triangle_offering(k);
    const int axis = dominant_axis(soup.planes[triangle.plane]);
    for (std::size_t e = 0; e < 3; ++e) {
      offer(plane_along_axis(soup.grid_points[triangle.corners[e]],
                             soup.grid_points[triangle.corners[(e + 1) % 3]], axis));
    }
  }
  return best;
}

}  // namespace meshrepair::internal
