// SPDX-License-Identifier: MIT
// Each point finds its tangent plane and, in it, its Delaunay star: the triangles that it wants.
// Where the sampling is good, all three corners of a triangle want it, and the triangles are a
// closed surface. Where four neighbours are nearly on one circle, the stars may disagree on the
// diagonal, and both pairs of triangles enclose a flat tetrahedron; where points are missing, there
// are holes. Both is left to the repair, which is made for it.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <base/error.h>
#include <base/parallel.h>
#include <base/release.h>
#include <points/point_soup.h>

#include "agreed_triangles.h"
#include "drop_crumbs.h"
#include "point_stars.h"
#include "project_points.h"
#include "sift_points.h"
#include "single_fans.h"
#include "tangent_plane.h"

namespace meshrepair {
namespace {

constexpr std::size_t kFewestPoints = 4;  // of a solid

double longest_side(const std::vector<Vec3d>& points, const std::array<std::uint32_t, 3>& corners) {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    longest = std::max(longest, (points[corners[k]] - points[corners[(k + 1) % 3]]).norm());
  }
  return longest;
}

void require_sense(const PointSoupOptions& options) {
  if (options.votes < 1 || options.votes > 3) {
    throw UsageError("triangles have 1 to 3 votes, not " + std::to_string(options.votes));
  }
  if (options.neighbours < 5) throw UsageError("a tangent plane needs 5 neighbours at least");
  if (!(options.reach > 0) || !std::isfinite(options.reach)) {
    throw UsageError("the reach of triangles must be above 0");
  }
  if (!(options.duplicate >= 0) || !(options.outlier >= 0) || options.project < 0) {
    throw UsageError("distances and numbers of iterations must not be negative");
  }
}

void require_points(const PointSoupReport& report) {
  if (report.points >= kFewestPoints) return;
  if (report.points == report.points_in) {
    throw NoSolidError("there are only " + std::to_string(report.points) +
                       " points, and a solid has four at least");
  }
  throw NoSolidError("of " + std::to_string(report.points_in) + " points only " +
                     std::to_string(report.points) +
                     " are left, which enclose nothing: the others are not finite, there twice or "
                     "outliers");
}

// Counts the votes; keeps what has enough of them, as the corners turn.
std::vector<VotedTriangle> count_votes(std::vector<StarTriangle> wanted, const SiftedCloud& cloud,
                                       const PointSoupOptions& options, PointSoupReport& report) {
  parallel_sort(wanted.begin(), wanted.end(),
                [](const StarTriangle& a, const StarTriangle& b) { return a.corners < b.corners; });
  std::vector<VotedTriangle> voted;
  for (std::size_t first = 0, last = 0; first < wanted.size(); first = last) {
    int turn = 0;
    for (; last < wanted.size() && wanted[last].corners == wanted[first].corners; ++last) {
      turn += wanted[last].turn;
    }
    const std::size_t votes = std::min<std::size_t>(last - first, 3);
    ++report.by_votes[votes - 1];
    if (votes < static_cast<std::size_t>(options.votes)) continue;
    auto corners = wanted[first].corners;
    if (turn < 0) std::swap(corners[1], corners[2]);
    voted.push_back({corners, static_cast<std::uint8_t>(votes), 0});
  }
  parallel_for(voted.size(), [&](std::size_t t) {
    voted[t].size = static_cast<float>(longest_side(cloud.points, voted[t].corners));
  });
  return voted;
}

// Takes away what would not let itself be closed.
void tidy(std::vector<VotedTriangle>& voted, const SiftedCloud& cloud,
          const std::vector<TangentPlane>& planes, const PointSoupOptions& options,
          PointSoupReport& report) {
  if (options.agree) {
    const std::size_t before = voted.size();
    CancelOnly cancel(options.progress);
    voted = agreed_triangles(cloud.points, planes, voted, &cancel);
    report.disagreed = before - voted.size();
    report.loose = keep_single_fans(voted, cloud.points.size());
  }
  report.crumbs = drop_crumbs(voted, options.fewest_triangles, options.outlier);
}

void require_triangles(const PointSoupOptions& options, const PointSoupReport& report) {
  if (report.triangles == 0) {
    throw NoSolidError("the " + std::to_string(report.points) +
                       " points make no surface: they are too few, too far apart, or along lines");
  }
  if (options.most_triangles > 0 && report.triangles > options.most_triangles) {
    throw LimitError(std::to_string(report.triangles) +
                     " triangles between the points, more than " +
                     std::to_string(options.most_triangles));
  }
}

PointSoup assemble(const PointCloud& cloud, const SiftedCloud& sifted,
                   const std::vector<VotedTriangle>& triangles, bool moved) {
  PointSoup result;
  result.soup.points.reserve(sifted.points.size());
  for (std::size_t p = 0; p < sifted.points.size(); ++p) {
    result.soup.points.push_back(moved ? sifted.centre + sifted.scale * sifted.points[p]
                                       : cloud.points[sifted.original[p]]);
  }
  result.soup.triangles.reserve(triangles.size());
  result.votes.reserve(triangles.size());
  for (const VotedTriangle& triangle : triangles) {
    result.soup.triangles.push_back(triangle.corners);
    result.votes.push_back(triangle.votes);
  }
  return result;
}

}  // namespace

double PointSoupReport::agreement() const {
  const auto& [one, two, three] = by_votes;
  return static_cast<double>(three) /
         static_cast<double>(std::max<std::size_t>(1, one + two + three));
}

std::vector<float> PointSoup::opacity() const {
  std::vector<float> share;
  share.reserve(votes.size());
  for (const std::uint8_t count : votes) share.push_back(static_cast<float>(count) / 3);
  return share;
}

PointSoup make_point_soup(const PointCloud& cloud, const PointSoupOptions& options,
                          PointSoupReport& report) {
  require_sense(options);
  SiftedCloud sifted = sift_points(cloud, options, report);
  require_points(report);
  report.normals_used = !sifted.normals.empty();
  if (options.project > 0) {
    report.farthest_move = sifted.scale * project_points(sifted, options);
    report.thinned = report.points - sifted.points.size();
    report.points = sifted.points.size();
    look_around(sifted, options);
  }
  const std::vector<TangentPlane> planes = find_tangent_planes(sifted, options);
  std::vector<StarTriangle> wanted = build_stars(sifted, planes, options);
  sifted.index.reset();
  release(sifted.around.points);
  std::vector<VotedTriangle> voted = count_votes(std::move(wanted), sifted, options, report);
  tidy(voted, sifted, planes, options, report);
  report.triangles = voted.size();
  require_triangles(options, report);
  return assemble(cloud, sifted, voted, options.project > 0);
}

}  // namespace meshrepair
