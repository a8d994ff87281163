// SPDX-License-Identifier: MIT
#include "agreed_triangles.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>
#include <tuple>

#include <Eigen/Geometry>

#include <base/angles.h>
#include <base/ids.h>
#include <base/parallel.h>

namespace meshrepair {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

// Sectors are found on several threads, but each triangle is taken or not once those before it are:
// for so many at a time, which take 3 megabytes.
constexpr std::size_t kAtATime = 65536;
constexpr std::size_t kSectorsPerTask = 1024;

// Directions from a point, counter-clockwise from `from`; less than half a turn wide.
struct Sector {
  double from = 0;
  double width = 0;
};

double turned_by(double from, double to) {
  const double by = to - from;
  return by < 0 ? by + kTurn : by;
}

// Sectors that share a border have it from the same numbers, so no tolerance is needed.
bool overlap(const Sector& a, const Sector& b) {
  return turned_by(a.from, b.from) < a.width || turned_by(b.from, a.from) < b.width;
}

class Agreement {
 public:
  Agreement(const std::vector<Vec3d>& points, const std::vector<TangentPlane>& planes)
      : points_(points), planes_(planes), last_at_(points.size(), kNone) {}

  // At each corner. May be asked by several threads.
  [[nodiscard]] std::array<Sector, 3> sectors_of(
      const std::array<std::uint32_t, 3>& corners) const {
    std::array<Sector, 3> sectors;
    for (std::size_t k = 0; k < 3; ++k) {
      sectors[k] = sector_of(corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]);
    }
    return sectors;
  }

  // Whether the triangle was taken.
  bool take(const std::array<std::uint32_t, 3>& corners, const std::array<Sector, 3>& sectors) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!is_free(corners[k], sectors[k])) return false;
    }
    for (std::size_t k = 0; k < 3; ++k) occupy(corners[k], sectors[k]);
    return true;
  }

 private:
  struct Taken {
    Sector sector;
    std::uint32_t next = kNone;  // at the same point
  };

  [[nodiscard]] Sector sector_of(std::uint32_t point, std::uint32_t a, std::uint32_t b) const {
    const Vec3d& normal = planes_[point].normal;
    const Vec3d axis = normal.unitOrthogonal();
    const Vec3d across = normal.cross(axis);
    const auto direction = [&](std::uint32_t other) {
      const Vec3d offset = points_[other] - points_[point];
      return arc_tangent(offset.dot(across), offset.dot(axis));
    };
    const double to_a = direction(a);
    const double to_b = direction(b);
    const double width = turned_by(to_a, to_b);
    if (width <= std::numbers::pi) return {to_a, width};
    return {to_b, turned_by(to_b, to_a)};
  }

  [[nodiscard]] bool is_free(std::uint32_t point, const Sector& sector) const {
    for (std::uint32_t t = last_at_[point]; t != kNone; t = taken_[t].next) {
      if (overlap(taken_[t].sector, sector)) return false;
    }
    return true;
  }

  void occupy(std::uint32_t point, const Sector& sector) {
    taken_.push_back({sector, last_at_[point]});
    last_at_[point] = static_cast<std::uint32_t>(taken_.size() - 1);
  }

  const std::vector<Vec3d>& points_;
  const std::vector<TangentPlane>& planes_;
  std::vector<std::uint32_t> last_at_;
  std::vector<Taken> taken_;
};

}  // namespace

std::vector<VotedTriangle> agreed_triangles(const std::vector<Vec3d>& points,
                                            const std::vector<TangentPlane>& planes,
                                            const std::vector<VotedTriangle>& wanted,
                                            ProgressObserver* progress) {
  std::vector<std::uint32_t> order(wanted.size());
  std::iota(order.begin(), order.end(), 0U);
  parallel_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tuple(-wanted[a].votes, wanted[a].size, a) <
           std::tuple(-wanted[b].votes, wanted[b].size, b);
  });
  Agreement agreement(points, planes);
  CancelCheck cancel(progress);
  std::vector<char> taken(wanted.size(), 0);
  std::vector<std::array<Sector, 3>> sectors(std::min(kAtATime, order.size()));
  for (std::size_t begin = 0; begin < order.size(); begin += kAtATime) {
    const std::size_t count = std::min(kAtATime, order.size() - begin);
    parallel_tasks(count, kSectorsPerTask, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        sectors[i] = agreement.sectors_of(wanted[order[begin + i]].corners);
      }
    });
    for (std::size_t i = 0; i < count; ++i) {
      cancel.tick();
      const std::uint32_t t = order[begin + i];
      taken[t] = agreement.take(wanted[t].corners, sectors[i]) ? 1 : 0;
    }
  }
  std::vector<VotedTriangle> result;
  for (std::size_t t = 0; t < wanted.size(); ++t) {
    if (taken[t] != 0) result.push_back(wanted[t]);
  }
  return result;
}

}  // namespace meshrepair
