// SPDX-License-Identifier: MIT
// How many triangles a size of cell leaves is found by trying: about two for each cell that the
// surface passes, so their number falls with the square of the size.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <base/ids.h>
#include <base/internal/hash_index.h>
#include <base/roots.h>
#include <mesh/cluster_points.h>

namespace meshrepair {
namespace {

using internal::hash_mix;
using internal::HashIndex;

constexpr double kMostCells = 1 << 20;  // along a side
constexpr int kTries = 5;
constexpr double kFullEnough = 0.8;  // of what is allowed: no smaller cells are tried
constexpr double kBelow = 0.95;      // aimed at, as the number of triangles is a guess

using Cell = std::array<std::uint32_t, 3>;

std::uint64_t hash_of(const Cell& cell) {
  return hash_mix(hash_mix(hash_mix(0, cell[0]), cell[1]), cell[2]);
}

// All of them different; their positions count from 0.
class CellTable {
 public:
  explicit CellTable(std::size_t expected) : index_(expected) {}

  // Whether it was there before is told by size().
  std::uint32_t position_of(const Cell& cell) {
    const auto fresh = static_cast<std::uint32_t>(cells_.size());
    if (index_.full(fresh)) {
      index_.grow(fresh, [&](std::uint32_t position) { return hash_of(cells_[position]); });
    }
    const std::uint32_t position = index_.find_or_insert(
        hash_of(cell), fresh, [&](std::uint32_t other) { return cells_[other] == cell; });
    if (position == fresh) cells_.push_back(cell);
    return position;
  }
  [[nodiscard]] std::size_t size() const { return cells_.size(); }

 private:
  HashIndex index_;
  std::vector<Cell> cells_;
};

// The smallest corner first, the same way round.
Cell turned(const std::array<std::uint32_t, 3>& t) {
  const auto k = static_cast<std::size_t>(std::min_element(t.begin(), t.end()) - t.begin());
  return {t[k], t[(k + 1) % 3], t[(k + 2) % 3]};
}

class Clusterer {
 public:
  Clusterer(const TriangleSoup& soup, std::span<const char> fixed)
      : soup_(soup), stays_(soup.points.size(), 0) {
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) look_at(t, fixed[t] != 0);
    for (const std::uint32_t t : fixed_) {
      for (const std::uint32_t p : soup.triangles[t]) stays_[p] = 1;
    }
    side_ = rest_.empty() ? 0 : (high_ / 2 - low_ / 2).maxCoeff();
  }

  ClusteredSoup run(std::size_t most) {
    std::vector<std::uint32_t> kept = rest_;
    if (rest_.size() > most) kept = fewer(most);
    ClusteredSoup result;
    result.source.resize(fixed_.size() + kept.size());
    std::merge(fixed_.begin(), fixed_.end(), kept.begin(), kept.end(), result.source.begin());
    take_triangles(result);
    return result;
  }

 private:
  void look_at(std::uint32_t t, bool is_fixed) {
    const auto& corners = soup_.triangles[t];
    if (!std::all_of(corners.begin(), corners.end(),
                     [&](std::uint32_t p) { return soup_.points[p].allFinite(); })) {
      return;
    }
    (is_fixed ? fixed_ : rest_).push_back(t);
    for (const std::uint32_t p : corners) {
      low_ = low_.cwiseMin(soup_.points[p]);
      high_ = high_.cwiseMax(soup_.points[p]);
    }
  }

  // Those of rest_ that are left with cells that are small enough; fills moved_.
  std::vector<std::uint32_t> fewer(std::size_t most) {
    std::vector<std::uint32_t> best;
    std::vector<std::uint32_t> best_moves;
    if (most == 0) return best;
    double cells = std::clamp(std::sqrt(static_cast<double>(most) / 4), 1.0, kMostCells);
    for (int attempt = 0; attempt < kTries; ++attempt) {
      std::vector<std::uint32_t> left = left_with(cells);
      const double share = static_cast<double>(left.size()) / static_cast<double>(most);
      if (left.size() <= most && left.size() >= best.size()) {
        best.swap(left);
        best_moves.swap(moved_);
      }
      if (share <= 1 && share >= kFullEnough) break;
      const double factor = std::sqrt(kBelow / std::max(share, 1e-4));
      cells = std::clamp(cells * factor, 1.0, kMostCells);
    }
    moved_.swap(best_moves);
    if (best.empty()) best = every_so_many(left_with(1), most);
    return best;
  }

  static std::vector<std::uint32_t> every_so_many(const std::vector<std::uint32_t>& from,
                                                  std::size_t wanted) {
    wanted = std::min(wanted, from.size());
    std::vector<std::uint32_t> some;
    some.reserve(wanted);
    for (std::size_t i = 0; i < wanted; ++i) some.push_back(from[i * from.size() / wanted]);
    return some;
  }

  std::vector<std::uint32_t> left_with(double cells) {
    move_points(cells);
    CellTable seen(rest_.size() / 2);
    std::vector<std::uint32_t> left;
    for (const std::uint32_t t : rest_) {
      const auto& [a, b, c] = soup_.triangles[t];
      const std::array<std::uint32_t, 3> now = {moved_[a], moved_[b], moved_[c]};
      if (now[0] == now[1] || now[1] == now[2] || now[2] == now[0]) continue;
      const std::size_t before = seen.size();
      if (seen.position_of(turned(now)) == before) left.push_back(t);
    }
    return left;
  }

  [[nodiscard]] Cell cell_of(const Vec3d& p, double cells) const {
    Cell cell{};
    if (!(side_ > 0)) return cell;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double share = std::clamp((p[k] / 2 - low_[k] / 2) / side_, 0.0, 1.0);
      cell[static_cast<std::size_t>(k)] = static_cast<std::uint32_t>(share * cells);
    }
    return cell;
  }

  // moved_ gets of each point of rest_ the one that it moves onto.
  void move_points(double cells) {
    moved_.assign(soup_.points.size(), kNone);
    CellTable table(soup_.points.size() / 8);
    std::vector<Vec3d> middles;
    std::vector<double> counts;
    for (const std::uint32_t t : rest_) {
      for (const std::uint32_t p : soup_.triangles[t]) {
        if (moved_[p] != kNone || stays_[p] != 0) continue;
        const std::uint32_t cell = table.position_of(cell_of(soup_.points[p], cells));
        middles.resize(table.size(), Vec3d::Zero());
        counts.resize(table.size(), 0);
        // A running mean: sums might be too large.
        middles[cell] += (soup_.points[p] - middles[cell]) / ++counts[cell];
        moved_[p] = cell;
      }
    }
    move_onto_nearest(middles);
  }

  void move_onto_nearest(const std::vector<Vec3d>& middles) {
    std::vector<std::uint32_t> nearest(middles.size(), kNone);
    std::vector<double> least(middles.size(), std::numeric_limits<double>::infinity());
    for (std::uint32_t p = 0; p < moved_.size(); ++p) {
      if (moved_[p] == kNone) continue;
      const double distance = stable_length(soup_.points[p] - middles[moved_[p]]);
      if (nearest[moved_[p]] != kNone && !(distance < least[moved_[p]])) continue;
      least[moved_[p]] = distance;
      nearest[moved_[p]] = p;
    }
    for (std::uint32_t p = 0; p < moved_.size(); ++p) {
      moved_[p] = moved_[p] == kNone ? p : nearest[moved_[p]];
    }
  }

  void take_triangles(ClusteredSoup& result) const {
    std::vector<std::uint32_t> number(soup_.points.size(), kNone);
    for (const std::uint32_t t : result.source) {
      std::array<std::uint32_t, 3> corners = soup_.triangles[t];
      for (std::uint32_t& p : corners) {
        if (!moved_.empty()) p = moved_[p];
        if (number[p] == kNone) {
          number[p] = static_cast<std::uint32_t>(result.soup.points.size());
          result.soup.points.push_back(soup_.points[p]);
        }
        p = number[p];
      }
      result.soup.triangles.push_back(corners);
    }
  }

  const TriangleSoup& soup_;
  std::vector<std::uint32_t> fixed_, rest_;  // triangles that are finite
  std::vector<char> stays_;                  // of each point
  Vec3d low_ = Vec3d::Constant(std::numeric_limits<double>::max());
  Vec3d high_ = Vec3d::Constant(std::numeric_limits<double>::lowest());
  double side_ = 0;  // half of the largest, as it may be too large for a double
  std::vector<std::uint32_t> moved_;
};

}  // namespace

ClusteredSoup cluster_points(const TriangleSoup& soup, std::span<const char> fixed,
                             std::size_t most) {
  return Clusterer(soup, fixed).run(most);
}

}  // namespace meshrepair
