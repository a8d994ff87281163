// SPDX-License-Identifier: MIT
#include "facing_rims.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace meshrepair::internal {
namespace {

constexpr std::size_t kSamples = 16;
// Rims that face each other are about as long: a stray triangle beside a mouth has no say.
constexpr double kAsLong = 4;

// About a second.
constexpr std::size_t kMostRimSteps = 200'000'000;
constexpr std::size_t kNowhere = ~std::size_t{0};

struct RimPoint {
  Vec3d at;
  std::size_t rim;
};

// All points of all rims in order along the axis on which they spread most.
class SortedPoints {
 public:
  SortedPoints(std::span<const Rim> rims, ProgressObserver* progress) : check_(progress) {
    Vec3d low = Vec3d::Constant(std::numeric_limits<double>::infinity());
    Vec3d high = -low;
    for (std::size_t r = 0; r < rims.size(); ++r) {
      for (const Vec3d& p : rims[r].points) {
        points_.push_back({p, r});
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
      lengths_.push_back(length_of(rims[r]));
    }
    (high - low).maxCoeff(&axis_);
    std::stable_sort(points_.begin(), points_.end(), [this](const RimPoint& a, const RimPoint& b) {
      return a.at[axis_] < b.at[axis_];
    });
  }

  // The rim other than `own`, and about as long, that comes nearest to a point; kNowhere if there
  // is none.
  [[nodiscard]] std::size_t nearest_rim(const Vec3d& p, std::size_t own) {
    const auto middle =
        std::lower_bound(points_.begin(), points_.end(), p[axis_],
                         [this](const RimPoint& q, double x) { return q.at[axis_] < x; });
    Nearest nearest;
    for (auto q = middle; q != points_.end() && !out_of_reach(*q, p, nearest); ++q) {
      note(*q, p, own, nearest);
    }
    for (auto q = middle; q != points_.begin() && !out_of_reach(*(q - 1), p, nearest);) {
      note(*--q, p, own, nearest);
    }
    return nearest.rim;
  }

 private:
  struct Nearest {
    double distance = std::numeric_limits<double>::infinity();  // squared
    std::size_t rim = kNowhere;
  };

  [[nodiscard]] bool out_of_reach(const RimPoint& q, const Vec3d& p, const Nearest& nearest) {
    check_.tick();
    if (++steps_ > kMostRimSteps) return true;
    const double along = q.at[axis_] - p[axis_];
    return along * along > nearest.distance;
  }

  void note(const RimPoint& q, const Vec3d& p, std::size_t own, Nearest& nearest) const {
    if (q.rim == own) return;
    const double length = lengths_[q.rim];
    if (length > kAsLong * lengths_[own] || kAsLong * length < lengths_[own]) return;
    const double distance = (q.at - p).squaredNorm();
    if (distance > nearest.distance) return;
    if (distance == nearest.distance && nearest.rim < q.rim) return;
    nearest = {distance, q.rim};
  }

  std::vector<RimPoint> points_;
  std::vector<double> lengths_;  // of the rims
  Eigen::Index axis_ = 0;
  CancelCheck check_;
  std::size_t steps_ = 0;
};

std::size_t nearest_to_most(SortedPoints& points, const Rim& rim, std::size_t own) {
  const std::size_t samples = std::min(kSamples, rim.size());
  std::vector<std::size_t> votes;
  for (std::size_t k = 0; k < samples; ++k) {
    votes.push_back(points.nearest_rim(rim.points[k * rim.size() / samples], own));
  }
  std::sort(votes.begin(), votes.end());
  for (std::size_t k = 0; k < samples; ++k) {
    if (std::upper_bound(votes.begin(), votes.end(), votes[k]) -
            std::lower_bound(votes.begin(), votes.end(), votes[k]) >
        static_cast<std::ptrdiff_t>(samples / 2)) {
      return votes[k];
    }
  }
  return kNowhere;
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> find_facing_rims(std::span<const Rim> rims,
                                                                  ProgressObserver* progress) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  if (rims.size() < 2) return pairs;
  SortedPoints points(rims, progress);
  std::vector<std::size_t> partner(rims.size());
  for (std::size_t r = 0; r < rims.size(); ++r) partner[r] = nearest_to_most(points, rims[r], r);
  for (std::size_t r = 0; r < rims.size(); ++r) {
    if (partner[r] != kNowhere && partner[r] > r && partner[partner[r]] == r) {
      pairs.emplace_back(r, partner[r]);
    }
  }
  return pairs;
}

}  // namespace meshrepair::internal
