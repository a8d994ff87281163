// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

#include <base/error.h>
#include <check/check_surface.h>
#include <exact/double_predicates.h>
#include <exact/volume_sign.h>
#include <mesh/topology.h>
#include <mesh/weld_points.h>

#include "part_nesting.h"

namespace meshrepair {
namespace {

// Beyond these no pair is marked; a mesh with more is marked nearly everywhere as it is.
constexpr std::size_t kMostMarkedPairs = 10'000'000;

std::uint16_t bit_of(Defect defect) {
  return static_cast<std::uint16_t>(1u << static_cast<unsigned>(defect));
}

class SurfaceChecker {
 public:
  SurfaceChecker(const TriangleSoup& soup, const CheckOptions& options)
      : soup_(soup), options_(options) {}

  SurfaceCheck run() {
    begin_stage("edges");
    check_.points = soup_.points.size();
    check_.triangles = soup_.triangles.size();
    if (options_.mark_triangles) check_.marks.assign(soup_.triangles.size(), 0);
    choose_triangles();
    find_unused_points();
    find_duplicates();
    find_topology_defects();
    begin_stage("crossings");
    find_self_intersections();
    begin_stage("parts");
    measure_parts();
    find_nesting();
    for (DefectPlaces& places : check_.defects) keep_first(places);
    return std::move(check_);
  }

 private:
  void begin_stage(std::string_view name) const {
    if (options_.progress == nullptr) return;
    options_.progress->stage(name);
    if (options_.progress->cancelled()) throw Cancelled();
  }

  // Counts one defect and marks the triangles that have it.
  void add(Defect defect, const Place& place, std::initializer_list<std::uint32_t> triangles) {
    DefectPlaces& places = check_[defect];
    ++places.count;
    places.first.push_back(place);
    // Places come in no certain order; the lowest are kept.
    if (places.first.size() > 2 * options_.most_places + 1000) keep_first(places);
    for (const std::uint32_t t : triangles) mark(t, defect);
  }

  void mark(std::uint32_t triangle, Defect defect) {
    if (options_.mark_triangles) check_.marks[triangle] |= bit_of(defect);
  }

  void keep_first(DefectPlaces& places) const {
    std::sort(places.first.begin(), places.first.end(),
              [](const Place& a, const Place& b) { return a.ids < b.ids; });
    if (places.first.size() > options_.most_places) places.first.resize(options_.most_places);
  }

  // The triangles that have three different corners, of welded points if these are to be.
  void choose_triangles() {
    const Vec3d nowhere = Vec3d::Constant(std::numeric_limits<double>::quiet_NaN());
    std::vector<std::uint32_t> welded;
    if (options_.weld) welded = first_in_place(soup_.points);
    for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
      IndexTriangle corners = soup_.triangles[t];
      if (options_.weld) {
        for (std::uint32_t& p : corners) p = welded[p];
      }
      const Vec3d &a = soup_.points[corners[0]], &b = soup_.points[corners[1]],
                  &c = soup_.points[corners[2]];
      if (!a.allFinite() || !b.allFinite() || !c.allFinite()) {
        add(Defect::not_finite_triangle, {{t, t}, nowhere}, {t});
        continue;
      }
      const bool repeated =
          corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
      if (repeated || projection_axis(a, b, c) < 0) {
        add(Defect::degenerate_triangle, {{t, t}, middle_of(corners)}, {t});
      }
      if (repeated) continue;
      triangles_.push_back(corners);
      ids_.push_back(t);
    }
  }

  [[nodiscard]] Vec3d middle_of(const IndexTriangle& corners) const {
    return soup_.points[corners[0]] / 3 + soup_.points[corners[1]] / 3 +
           soup_.points[corners[2]] / 3;
  }

  void find_unused_points() {
    std::vector<char> used(soup_.points.size(), 0);
    for (const auto& corners : soup_.triangles) {
      for (const std::uint32_t p : corners) used[p] = 1;
    }
    for (std::uint32_t p = 0; p < soup_.points.size(); ++p) {
      if (used[p] == 0) add(Defect::unused_point, {{p, p}, soup_.points[p]}, {});
    }
  }

  // By the coordinates of their corners: what lies in one place is there twice, whatever the
  // indices.
  void find_duplicates() {
    const std::vector<std::uint32_t> place_of = first_in_place(soup_.points);
    std::vector<IndexTriangle> sorted = triangles_;
    for (IndexTriangle& corners : sorted) {
      for (std::uint32_t& corner : corners) corner = place_of[corner];
      std::sort(corners.begin(), corners.end());
    }
    std::vector<std::uint32_t> order(sorted.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(sorted[a], a) < std::pair(sorted[b], b);
    });
    for (std::size_t first = 0, i = 1; i < order.size(); ++i) {
      const IndexTriangle& corners = sorted[order[i]];
      if (corners != sorted[order[first]]) first = i;
      const bool flat = corners[0] == corners[1] || corners[1] == corners[2];
      if (first == i || flat) continue;
      const std::uint32_t original = ids_[order[first]], copy = ids_[order[i]];
      mark(original, Defect::duplicate_triangle);
      add(Defect::duplicate_triangle, {{original, copy}, middle_of(triangles_[order[i]])}, {copy});
    }
  }

  void find_topology_defects() {
    const Topology topology = examine_topology(triangles_, soup_.points.size(), &places_);
    check_.edges = topology.edges;
    check_.parts.resize(topology.parts);
    add_edges(Defect::open_edge, places_.open_sides);
    add_edges(Defect::nonmanifold_edge, places_.nonmanifold_sides);
    add_edges(Defect::inconsistent_edge, places_.inconsistent_sides);
    std::vector<char> touching(soup_.points.size(), 0);
    for (const std::uint32_t p : places_.nonmanifold_vertices) {
      touching[p] = 1;
      add(Defect::nonmanifold_vertex, {{p, p}, soup_.points[p]}, {});
    }
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      for (const std::uint32_t p : triangles_[t]) {
        if (touching[p] != 0) mark(ids_[t], Defect::nonmanifold_vertex);
      }
    }
  }

  // Sides of one edge follow each other.
  void add_edges(Defect defect, const std::vector<std::uint32_t>& sides) {
    std::array<std::uint32_t, 2> last = {0, 0};
    for (const std::uint32_t side : sides) {
      mark(ids_[side / 3], defect);
      const std::uint32_t p = side_start(triangles_, side);
      const std::uint32_t q = side_start(triangles_, next_side(side));
      const std::array<std::uint32_t, 2> ends = {std::min(p, q), std::max(p, q)};
      if (ends == last) continue;
      last = ends;
      add(defect, {ends, 0.5 * soup_.points[p] + 0.5 * soup_.points[q]}, {});
    }
  }

  void find_self_intersections() {
    SelfIntersectionOptions options;
    options.most_pairs = options_.mark_triangles ? std::max(kMostMarkedPairs, options_.most_places)
                                                 : options_.most_places;
    options.progress = options_.progress;
    check_.self_intersections = self_intersections(soup_, options);
    for (const auto& pair : check_.self_intersections.pairs) {
      const Vec3d at =
          0.5 * middle_of(soup_.triangles[pair[0]]) + 0.5 * middle_of(soup_.triangles[pair[1]]);
      add(Defect::self_intersection, {pair, at}, {pair[0], pair[1]});
    }
    check_[Defect::self_intersection].count = check_.self_intersections.count;
  }

  void measure_parts() {
    check_.volume = signed_volume(finite_soup());
    for (std::size_t t = triangles_.size(); t-- > 0;) {
      SurfacePart& part = check_.parts[places_.parts[t]];
      ++part.triangles;
      part.first_triangle = ids_[t];
      const Vec3d& a = soup_.points[triangles_[t][0]];
      const Vec3d ab = soup_.points[triangles_[t][1]] - a, ac = soup_.points[triangles_[t][2]] - a;
      part.area += 0.5 * ab.cross(ac).norm();
      part.closed = true;
    }
    for (const SurfacePart& part : check_.parts) check_.area += part.area;
    find_unbalanced_parts();
  }

  // The triangles that count, with the points as they are.
  [[nodiscard]] TriangleSoup finite_soup() const { return {soup_.points, triangles_}; }

  void find_unbalanced_parts() {
    const auto part_of_side = [&](std::uint32_t side) -> SurfacePart& {
      return check_.parts[places_.parts[side / 3]];
    };
    for (const std::uint32_t side : places_.open_sides) part_of_side(side).closed = false;
    for (const std::uint32_t side : places_.inconsistent_sides) part_of_side(side).closed = false;
    const auto& sides = places_.nonmanifold_sides;
    for (std::size_t i = 0; i < sides.size();) {
      const std::uint32_t p = side_start(triangles_, sides[i]);
      const std::uint32_t q = side_start(triangles_, next_side(sides[i]));
      int balance = 0;
      const std::size_t begin = i;
      for (; i < sides.size(); ++i) {
        const std::uint32_t from = side_start(triangles_, sides[i]);
        const std::uint32_t to = side_start(triangles_, next_side(sides[i]));
        if (!(from == p && to == q) && !(from == q && to == p)) break;
        balance += from == p ? 1 : -1;
      }
      if (balance != 0) part_of_side(sides[begin]).closed = false;
    }
  }

  void find_nesting() {
    std::vector<std::uint32_t> closed_parts;
    std::vector<std::uint32_t> number(check_.parts.size(), internal::kNoPart);
    for (std::uint32_t p = 0; p < check_.parts.size(); ++p) {
      if (!check_.parts[p].closed) continue;
      number[p] = static_cast<std::uint32_t>(closed_parts.size());
      closed_parts.push_back(p);
    }
    const TriangleSoup soup = finite_soup();
    std::vector<std::uint32_t> part_of;
    std::vector<std::vector<std::uint32_t>> members(closed_parts.size());
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
      part_of.push_back(number[places_.parts[t]]);
      if (part_of[t] != internal::kNoPart) members[part_of[t]].push_back(t);
    }
    const std::vector<std::uint32_t> depths =
        internal::find_nesting(soup, part_of, closed_parts.size(), options_.progress).depth;
    for (std::size_t i = 0; i < closed_parts.size(); ++i) {
      SurfacePart& part = check_.parts[closed_parts[i]];
      part.depth = depths[i];
      part.facing = volume_sign(soup.points, soup.triangles, members[i]);
      part.volume = volume_of(soup, members[i]);
      judge_orientation(part, members[i]);
    }
  }

  [[nodiscard]] static double volume_of(const TriangleSoup& soup,
                                        const std::vector<std::uint32_t>& members) {
    const Vec3d& base = soup.points[soup.triangles[members[0]][0]];
    double sum = 0;
    for (const std::uint32_t t : members) {
      const auto& corners = soup.triangles[t];
      const Vec3d a = soup.points[corners[0]] - base, b = soup.points[corners[1]] - base;
      sum += a.dot(b.cross(soup.points[corners[2]] - base));
    }
    return sum / 6;
  }

  // With an odd number of parts around it a part is the wall of a cavity, and faces inward. Where
  // triangles cross, the depth of a part's first corner need not be that of the rest, unless it is
  // outside of everything.
  void judge_orientation(SurfacePart& part, const std::vector<std::uint32_t>& members) {
    const bool crosses = check_.self_intersections.count > 0;
    const bool is_cavity = part.depth % 2 == 1;
    if (crosses && part.depth > 0) return;
    check_.cavities += !crosses && is_cavity;
    part.inside_out = part.facing == (is_cavity ? 1 : -1);
    if (!part.inside_out) return;
    const std::uint32_t first = part.first_triangle;
    add(Defect::inside_out_part, {{first, first}, middle_of(soup_.triangles[first])}, {});
    for (const std::uint32_t t : members) mark(ids_[t], Defect::inside_out_part);
  }

  const TriangleSoup& soup_;
  const CheckOptions& options_;
  SurfaceCheck check_;
  std::vector<IndexTriangle> triangles_;  // that count, in the order of the soup
  std::vector<std::uint32_t> ids_;        // their numbers in the soup
  TopologyPlaces places_;                 // of triangles_
};

}  // namespace

std::string_view defect_name(Defect defect) {
  constexpr std::array<std::string_view, kDefects> kNames = {
      "open_edges",           "nonmanifold_edges",    "inconsistent_edges",  "nonmanifold_vertices",
      "degenerate_triangles", "not_finite_triangles", "duplicate_triangles", "self_intersections",
      "inside_out_parts",     "unused_points"};
  return kNames[static_cast<std::size_t>(defect)];
}

bool SurfaceCheck::closed() const {
  return triangles > 0 && (*this)[Defect::open_edge].count == 0 && !parts.empty();
}

bool SurfaceCheck::manifold() const {
  return (*this)[Defect::nonmanifold_edge].count == 0 &&
         (*this)[Defect::nonmanifold_vertex].count == 0;
}

bool SurfaceCheck::oriented() const { return (*this)[Defect::inconsistent_edge].count == 0; }

// What hangs together at a manifold edge faces one way; beyond other edges it may be two surfaces,
// one of them inside out.
bool SurfaceCheck::outward() const {
  if ((*this)[Defect::nonmanifold_edge].count > 0) return false;
  if ((*this)[Defect::self_intersection].count > 0) return false;
  return !parts.empty() && std::all_of(parts.begin(), parts.end(), [](const SurfacePart& part) {
    return part.closed && part.facing != 0 && !part.inside_out;
  });
}

bool SurfaceCheck::valid_solid() const {
  const auto none = [this](Defect defect) { return (*this)[defect].count == 0; };
  return closed() && manifold() && oriented() && outward() && none(Defect::degenerate_triangle) &&
         none(Defect::not_finite_triangle) && none(Defect::duplicate_triangle) &&
         none(Defect::self_intersection);
}

SurfaceCheck check_surface(const TriangleSoup& soup, const CheckOptions& options) {
  return SurfaceChecker(soup, options).run();
}

}  // namespace meshrepair
