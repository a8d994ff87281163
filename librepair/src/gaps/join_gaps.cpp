// SPDX-License-Identifier: MIT
// Gaps are joined in the soup, before anything else: what comes after finds copies of triangles,
// which it handles exactly.
//
// - Near faces are found (near_faces.h). What is thin is compared with the distance.
// - Corners that are near each other become one, and move into the planes that their faces have in
//   common with others (level_faces.h).
// - Round by round, corners come to lie on edges and faces near them, and edges that pass each
//   other get a point there (near_parts.h). Edges are always those that were given, so this ends.
// - Each triangle is cut along all edges between points that it has (cut_near_mesh.h). A region
//   between edges gets the same triangles in all faces that it is in (face_pieces.h).
//
// A closed body stays closed whatever the coordinates are, as both triangles at an edge get the
// points on it. Where features are as narrow as gaps, regions may differ: then a slit stays, which
// the report counts.
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include <base/error.h>
#include <base/roots.h>
#include <check/box_tree.h>
#include <check/near_faces.h>
#include <repair/join_gaps.h>

#include "near_mesh.h"
#include "near_parts.h"

namespace meshrepair {
namespace {

// What is thin has to be so many times the distance, so that its two sides stay apart.
constexpr double kThin = 2;
// Of the distance: what is left of a gap by rounding.
constexpr double kClosed = 1e-3;

// How far beyond the widest gap to go: corners that belong together may be farther apart.
constexpr double kGapMargin = 2;

// Of gaps that nobody named: how much narrower they are than anything else, and how wide they are
// at most, as a share of the diagonal and of the longest edges beside them.
constexpr double kFarApart = 10;
constexpr double kWidestGap = 1e-2, kBesideEdges = 0.1;

// 0 where nothing is finite.
double finite_diagonal(const TriangleSoup& soup) {
  Box box;
  for (const auto& t : soup.triangles) {
    for (const std::uint32_t p : t) {
      if (soup.points[p].allFinite()) box.add(soup.points[p]);
    }
  }
  return box.low[0] <= box.high[0] ? box.diagonal() : 0;
}

// What is as thin as that, or short.
struct Thinnest {
  double width = std::numeric_limits<double>::infinity();
  const char* what = "";
  Vec3d at = Vec3d::Zero();

  void add(double other, const char* name, const Vec3d& place) {
    if (other < width) *this = {other, name, place};
  }
};

void add_walls(const TriangleSoup& soup, const NearFacesFound& near, Thinnest& thinnest) {
  for (const NearFaces& wall : near.walls) {
    thinnest.add(wall.apart, "a wall", soup.points[soup.triangles[wall.a][0]]);
  }
}

void add_edges(const TriangleSoup& soup, const NearFaces& gap, Thinnest& thinnest) {
  for (const std::uint32_t t : {gap.a, gap.b}) {
    const auto& c = soup.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d &a = soup.points[c[k]], &b = soup.points[c[(k + 1) % 3]];
      if (a != b) thinnest.add((b - a).norm(), "an edge", a);
    }
  }
}

Thinnest find_thinnest(const TriangleSoup& soup, const NearFacesFound& near) {
  Thinnest thinnest;
  add_walls(soup, near, thinnest);
  for (const NearFaces& gap : near.gaps) add_edges(soup, gap, thinnest);
  return thinnest;
}

double distance_for(const TriangleSoup& soup, const JoinGapsOptions& options) {
  if (options.mode == JoinGapsMode::none) return 0;
  if (options.mode == JoinGapsMode::automatic) {
    return propose_gaps(soup, options.progress).distance;
  }
  return options.is_share ? options.distance * finite_diagonal(soup) : options.distance;
}

// Below it, with two digits.
double rounded_down(double value) {
  const double unit = power_of_ten(decimal_exponent(value) - 1);
  return std::floor(value / unit) * unit;
}

void require_less_than(const Thinnest& thinnest, double distance) {
  if (thinnest.width >= kThin * distance) return;
  std::ostringstream text;
  text << "gaps of " << distance << " cannot be joined: the mesh has " << thinnest.what
       << " of only " << thinnest.width << " at (" << thinnest.at.x() << ", " << thinnest.at.y()
       << ", " << thinnest.at.z() << ")";
  if (thinnest.width > 0) {
    text << ", so the largest distance that would do is " << rounded_down(thinnest.width / kThin);
  }
  throw ValueError(text.str());
}

}  // namespace

GapProposal propose_gaps(const TriangleSoup& soup, ProgressObserver* progress) {
  NearFacesOptions looking;
  looking.largest_distance = kWidestGap * finite_diagonal(soup);
  looking.share = kBesideEdges;
  looking.progress = progress;
  NearFacesFound near = find_near_faces(soup, looking);
  std::erase_if(near.gaps, [](const NearFaces& gap) { return gap.apart == 0; });
  std::stable_sort(near.gaps.begin(), near.gaps.end(),
                   [](const NearFaces& x, const NearFaces& y) { return x.apart < y.apart; });
  Thinnest thinnest;
  add_walls(soup, near, thinnest);
  GapProposal proposal;
  for (std::size_t i = 0; i < near.gaps.size(); ++i) {
    add_edges(soup, near.gaps[i], thinnest);
    const double gap = near.gaps[i].apart;
    const double next =
        i + 1 < near.gaps.size() ? near.gaps[i + 1].apart : looking.largest_distance;
    if (kFarApart * gap <= std::min(next, thinnest.width))
      proposal = {i + 1, gap, kGapMargin * gap};
  }
  return proposal;
}

std::optional<JoinedSoup> join_gaps(const TriangleSoup& soup, const JoinGapsOptions& options,
                                    JoinGapsReport& report) {
  report = {};
  CancelCheck check(options.progress);
  const double distance = std::max(distance_for(soup, options), options.touching);
  if (!(distance > 0)) return std::nullopt;
  NearFacesOptions looking;
  looking.largest_distance = kThin * distance;
  looking.progress = options.progress;
  NearFacesFound near = find_near_faces(soup, looking);
  std::erase_if(near.gaps, [&](const NearFaces& gap) { return gap.apart > distance; });
  require_less_than(find_thinnest(soup, near), distance);
  for (const NearFaces& gap : near.gaps) {
    report.pairs += gap.apart > 0 ? 1 : 0;
    report.widest_gap = std::max(report.widest_gap, gap.apart);
  }
  report.distance = distance;
  if (near.gaps.empty() || (report.pairs == 0 && options.touching == 0)) return std::nullopt;
  // Where gaps are narrower than was asked for, so is what is taken for near beside them.
  const double widest = std::max(report.widest_gap, options.touching / kGapMargin);
  const double within = std::min(distance, kGapMargin * widest);
  internal::NearParts parts(soup, near.gaps, widest, within, check);
  JoinedSoup joined = internal::cut_near_mesh(soup, parts.bring_together(), report, check);
  looking.largest_distance = distance;
  for (const NearFaces& gap : find_near_faces(joined.soup, looking).gaps) {
    report.left += gap.apart > kClosed * distance ? 1 : 0;
  }
  return joined;
}

}  // namespace meshrepair
