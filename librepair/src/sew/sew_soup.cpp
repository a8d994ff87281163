// SPDX-License-Identifier: MIT
// Sewing brings open edges together that nearly meet, before holes are closed: corners near each
// other become one in their middle, and a corner near an open edge splits it. How far is decided
// once for the whole mesh. Each corner is asked how near the nearest strange edge is, one that no
// triangle of its own has, as a share of the edges around it; of the distances that are small so,
// the largest one before a wide gap is taken: distances that are meant lie far from those that
// noise has made.
//
// Then all clusters are joined at once, and what turned out wrong is given up, round by round:
// clusters of which a triangle was turned over, and those at which no open edge found a partner or
// an edge of more than two triangles came up. What is given up stays as it was given, so each round
// is sound, and there are few.
//
// Compare G. Barequet and S. Kumar, Repairing CAD models (1997), who match edges by a distance too,
// and A. Gueziec et al., Cutting and stitching (2001).
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include <base/ids.h>
#include <repair/sew_soup.h>

#include "corner_clusters.h"
#include "open_rims.h"
#include "split_edges.h"
#include "strangers.h"

namespace meshrepair {
namespace {

using internal::CornerClusters;
using internal::EdgeSplit;
using internal::OpenRims;
using internal::Strangers;

// Of the edges at a corner: nearer than the first share it is where another should be; it is moved
// by no more than the second.
constexpr double kNear = 0.25, kMove = 0.33;
// Of the diagonal: what is farther apart is so on purpose.
constexpr double kFarthest = 1.0 / 250;
// Between distances that belong together.
constexpr double kGap = 10;
constexpr int kMostSewings = 8;

double diagonal_of(const TriangleSoup& soup, const OpenRims& rims) {
  Vec3d low = Vec3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const IndexTriangle& t : rims.triangles) {
    for (const std::uint32_t p : t) {
      if (!soup.points[p].allFinite()) continue;
      low = low.cwiseMin(soup.points[p]);
      high = high.cwiseMax(soup.points[p]);
    }
  }
  return low.x() <= high.x() ? (high - low).norm() : 0;
}

// Of distances, ascending: where half of them or more lie far below the rest, these are meant.
double largest_before_gap(const std::vector<double>& distances) {
  double largest = distances.back(), widest = kGap;
  for (std::size_t i = distances.size() / 2; i + 1 < distances.size(); ++i) {
    if (distances[i + 1] <= widest * distances[i]) continue;
    widest = distances[i + 1] / distances[i];
    largest = distances[i];
  }
  return largest;
}

class Sewing {
 public:
  Sewing(const TriangleSoup& soup, OpenRims rims, SewReport& report, ProgressObserver* progress)
      : soup_(soup),
        rims_(std::move(rims)),
        strangers_(soup, rims_),
        clusters_(soup, rims_),
        report_(report),
        progress_(progress),
        check_(progress) {}

  // That corners are apart by mistake; 0 if none are. If most are apart by more than is taken for
  // one, report.refused_distance is that.
  [[nodiscard]] double automatic_distance() const {
    std::vector<double> near = distances_of_strangers(strangers_, rims_, kNear, progress_);
    const double most = kFarthest * diagonal_of(soup_, rims_);
    std::erase_if(near, [](double distance) { return !std::isfinite(distance); });
    std::sort(near.begin(), near.end());
    const auto too_far = std::find_if(near.begin(), near.end(),
                                      [&](double distance) { return 2 * distance > most; });
    if (2 * (near.end() - too_far) > static_cast<std::ptrdiff_t>(rims_.corners.size())) {
      report_.refused_distance = 2 * near.back();
      return 0;
    }
    near.erase(too_far, near.end());
    return near.empty() ? 0 : 2 * largest_before_gap(near);
  }

  [[nodiscard]] double distance_for(const SewOptions& options) const {
    if (options.mode == SewMode::automatic) return automatic_distance();
    return options.is_share ? options.distance * diagonal_of(soup_, rims_) : options.distance;
  }

  std::optional<SewnSoup> run(double distance) {
    if (!clusters_.join(distance, is_loose() ? std::numeric_limits<double>::infinity() : kMove,
                        check_)) {
      report_.refused_distance = distance;
      return std::nullopt;
    }
    check_.ask();
    if (!is_loose()) splits_ = find_splits(rims_, strangers_, clusters_, distance, kMove);
    for (int round = 0; round < kMostSewings; ++round) {
      check_.ask();
      SewnSoup sewn = make_soup();
      std::vector<char> given_up(soup_.points.size(), 0);
      give_up_turned(sewn, is_loose() ? 2 * distance : 0, given_up);
      const OpenRims after = internal::find_open_rims(sewn.soup);
      if (!is_loose()) give_up_useless(after, given_up);
      if (std::find(given_up.begin(), given_up.end(), 1) == given_up.end()) {
        return finish(std::move(sewn), after, distance);
      }
      std::erase_if(splits_, [&](const EdgeSplit& split) {
        return given_up[clusters_.of(split.corner)] != 0;
      });
      clusters_.dissolve(given_up);
    }
    return std::nullopt;
  }

 private:
  // Hardly any two triangles have an edge in common: all corners are where noise has put them, and
  // what is smaller than that has no shape to be kept.
  [[nodiscard]] bool is_loose() const {
    constexpr double kLoose = 0.9;
    return static_cast<double>(rims_.sides.size()) >=
           kLoose * 3 * static_cast<double>(rims_.triangles.size());
  }

  [[nodiscard]] SewnSoup make_soup() const {
    SewnSoup sewn;
    sewn.soup.points = clusters_.middles();
    // Points in one place move together.
    std::vector<Vec3d>& points = sewn.soup.points;
    for (std::size_t t = 0; t < soup_.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        points[soup_.triangles[t][k]] = points[rims_.triangles[t][k]];
      }
    }
    auto split = splits_.begin();
    for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
      const auto first = split;
      while (split != splits_.end() && split->side / 3 == t) ++split;
      if (first == split) {
        sewn.soup.triangles.push_back(soup_.triangles[t]);
        sewn.source.push_back(t);
        continue;
      }
      for (const IndexTriangle& piece :
           internal::split_triangle(soup_.triangles[t], &*first, &*first + (split - first))) {
        sewn.soup.triangles.push_back(piece);
        sewn.source.push_back(t);
      }
    }
    return sewn;
  }

  // Clusters of which a triangle is turned over that is higher than this.
  void give_up_turned(const SewnSoup& sewn, double height, std::vector<char>& given_up) const {
    for (std::size_t t = 0; t < sewn.source.size(); ++t) {
      const IndexTriangle& was = rims_.triangles[sewn.source[t]];
      const auto& c = sewn.soup.triangles[t];
      const bool is_whole = c == soup_.triangles[sewn.source[t]];
      const bool is_moved = std::any_of(c.begin(), c.end(), [&](std::uint32_t p) {
        return sewn.soup.points[p] != soup_.points[p];
      });
      if ((!is_moved && is_whole) || faces_as(area(soup_, was), area(sewn.soup, c))) continue;
      if (least_height(soup_, was) <= height) continue;
      for (const std::uint32_t p : c) given_up[clusters_.of(rims_.place[p])] = 1;
    }
  }

  // Those at which no open edge found a partner, or an edge of more than two triangles came up; of
  // a corner that only splits an edge, both halves have to find one.
  void give_up_useless(const OpenRims& after, std::vector<char>& given_up) const {
    struct Fate {
      std::uint32_t open = 0;  // edges before
      bool is_joined = false, is_split = false, was_crowded = false;
    };
    std::vector<Fate> fates(soup_.points.size());
    for (const std::uint32_t corner : rims_.corners) {
      Fate& fate = fates[clusters_.of(corner)];
      fate.open += rims_.open_at[corner];
      fate.is_joined = fate.is_joined || clusters_.of(corner) != corner;
      fate.was_crowded = fate.was_crowded || rims_.is_crowded[corner] != 0;
    }
    for (const EdgeSplit& split : splits_) {
      Fate& fate = fates[clusters_.of(split.corner)];
      fate.open += 2;
      fate.is_split = true;
    }
    for (const std::uint32_t corner : rims_.corners) {
      const Fate& fate = fates[corner];
      if (!fate.is_joined && !fate.is_split) continue;
      const std::uint32_t place = after.place[corner];
      const std::uint32_t paired = fate.is_joined ? 2 : 4;
      const bool is_better =
          after.open_at[place] == 0 || after.open_at[place] + paired <= fate.open;
      const bool is_crowded = after.is_crowded[place] != 0 && !fate.was_crowded;
      if (!is_better || is_crowded) given_up[corner] = 1;
    }
  }

  // From where the corner was to where the edge was.
  [[nodiscard]] double gap_of(const EdgeSplit& split) const {
    const auto [a, b] = internal::ends_of(rims_, split.side);
    const auto& at = soup_.points;
    return std::sqrt(internal::nearest_on_edge(at[split.corner], at[a], at[b]).squared_distance);
  }

  static Vec3d area(const TriangleSoup& soup, const IndexTriangle& t) {
    const Vec3d& a = soup.points[t[0]];
    return (soup.points[t[1]] - a).cross(soup.points[t[2]] - a);
  }

  static double least_height(const TriangleSoup& soup, const IndexTriangle& t) {
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      longest = std::max(longest, (soup.points[t[(k + 1) % 3]] - soup.points[t[k]]).norm());
    }
    return longest > 0 ? area(soup, t).norm() / longest : 0;
  }

  // What had no area before has no side, and neither has what is not finite.
  static bool faces_as(const Vec3d& before, const Vec3d& after) {
    return before.squaredNorm() == 0 || !(before.dot(after) <= 0);
  }

  std::optional<SewnSoup> finish(SewnSoup sewn, const OpenRims& after, double distance) {
    for (const std::uint32_t corner : rims_.corners) {
      const double move = (sewn.soup.points[corner] - soup_.points[corner]).norm();
      report_.joined_points += clusters_.of(corner) != corner ? 1 : 0;
      report_.farthest_move = std::max(report_.farthest_move, move);
    }
    report_.split_edges = splits_.size();
    for (const IndexTriangle& t : rims_.triangles) {
      const auto same = [&](std::size_t k) {
        return clusters_.of(t[k]) == clusters_.of(t[(k + 1) % 3]) && t[k] != t[(k + 1) % 3];
      };
      report_.lost_triangles += same(0) || same(1) || same(2) ? 1 : 0;
    }
    if (report_.joined_points == 0 && splits_.empty()) return std::nullopt;
    report_.distance = distance;
    report_.widest_gap = clusters_.widest_gap();
    for (const EdgeSplit& split : splits_) {
      report_.widest_gap = std::max(report_.widest_gap, gap_of(split));
    }
    report_.sewn_edges = rims_.sides.size() - std::min(rims_.sides.size(), after.sides.size());
    return sewn;
  }

  const TriangleSoup& soup_;
  OpenRims rims_;
  Strangers strangers_;
  CornerClusters clusters_;
  std::vector<EdgeSplit> splits_;
  SewReport& report_;
  ProgressObserver* progress_;
  CancelCheck check_;
};

}  // namespace

std::optional<SewnSoup> sew_soup(const TriangleSoup& soup, const SewOptions& options,
                                 SewReport& report) {
  report = {};
  if (options.mode == SewMode::none) return std::nullopt;
  OpenRims rims = internal::find_open_rims(soup);
  report.open_edges = rims.sides.size();
  if (rims.sides.empty()) return std::nullopt;
  Sewing sewing(soup, std::move(rims), report, options.progress);
  const double distance = sewing.distance_for(options);
  if (!(distance > 0)) return std::nullopt;
  std::optional<SewnSoup> sewn = sewing.run(distance);
  const bool pays = report.sewn_edges >= report.joined_points + report.split_edges;
  if (sewn && options.mode == SewMode::automatic && !pays) {
    report = {.open_edges = report.open_edges};
    sewn.reset();
  }
  return sewn;
}

}  // namespace meshrepair
