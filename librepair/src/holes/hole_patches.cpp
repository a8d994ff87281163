// SPDX-License-Identifier: MIT
// Idea: a hole is closed by the triangulation of its rim that has the least area and hardly folds
// (loop_triangulation.h); what such a patch crosses is resolved later, by cutting, so it need not
// be free of intersections. The work is in what is a hole and what is not:
//
// - Two rims that face each other, closed for less area than apart, are one gap, closed by a ring:
//   between the two walls of a vessel, or two pieces of a surface.
// - A patch that has more than a share of the area of what it closes is no patch: the surface is an
//   open sheet. Sheets that share rims or rings count as one, and all patches of one together, the
//   largest judged first (sheet_rims.h).
// - A patch that folds back onto the surface would be a copy of it.
// - A patch of a hole in something round is refined and bent as the surface around it goes on
//   (curve_patch.h), unless the rim is a cut or the bounding box would grow.
//
// Patches are found in parallel, and added in the order of the loops. A patch that makes a triangle
// again that is there already is dropped. Least area after G. Barequet and M. Sharir, Filling gaps
// in the boundary of a polyhedron (1995); refining and bending after P. Liepa, Filling holes in
// meshes (2003).
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <base/disjoint_sets.h>
#include <base/error.h>
#include <base/parallel.h>
#include <base/shared_progress.h>
#include <bsp/internal/corners.h>
#include <mesh/edge_table.h>
#include <repair/hole_patches.h>
#include <repair/orient_parts.h>

#include "boundary_loops.h"
#include "collars.h"
#include "curve_patch.h"
#include "facing_rims.h"
#include "flanges.h"
#include "loop_triangulation.h"
#include "new_points.h"
#include "notches.h"
#include "rim.h"
#include "sheet_rims.h"

namespace meshrepair {
namespace {

using internal::BoundaryLoops;
using internal::CornerIds;
using internal::FilledNotches;
using internal::LoopTriangulation;
using internal::LoopTriangulationOptions;
using internal::Rim;
using internal::StripTriangulation;

// A ring between two rims takes the product of their lengths; beyond that they are closed one by
// one.
constexpr std::size_t kLargestRing = 4'000'000;

// Missing triangles that happen to face each other are no gap: the patch of one rim at least has to
// have this share of the area that it is joined to.
constexpr double kMouth = 0.01;

// From this share on the gap is between two pieces. It is between the walls of a vessel if one of
// two pieces lies within the other, ...
constexpr double kLargeOpening = 0.1;

// ... or if both are one piece and the ring has less than this share of the area of the patches: a
// wall is thin beside its mouth.
constexpr double kNarrow = 0.33;

// A ring has to have less than this share of the area of two patches: those over holes that touch
// in a point are a ring, too.
constexpr double kWorthARing = 0.9;

// A ring that joins a piece of surface to an opening may be so much larger than a patch of the
// opening, and the piece's area more: a lid belongs to a box, the ground below it does not.
constexpr double kLargerThanPatch = 1.5;

// A patch lies in a plane if its area is hardly larger than that of its projection onto one.
constexpr double kFlat = 0.999;

// A patch of more than this share of its part is rather the floor of a hill than a hole in
// something round.
constexpr double kLargestCurved = 0.45;

// Of the bounding box, by a curved patch, as a share of its rim's width.
constexpr double kMostGrowth = 0.01;

// A patch may lie on the surface where it is small beside it: there two sheets overlap by a seam.
constexpr double kSmallPatch = 0.1;

struct Sheets {
  DisjointSets sets;         // of triangles, joined where two meet at an edge
  std::vector<double> area;  // of each root, in square grid steps
};

// A ring between two loops.
struct Ring {
  std::size_t loop = 0;  // one of them
  double area = 0;
};

Vec3d position(const CleanSoup& soup, PointId p) { return as_vector(soup.grid_points[p]); }

double area_of(const CleanSoup& soup, const CornerIds& corners) {
  return internal::triangle_area(position(soup, corners[0]), position(soup, corners[1]),
                                 position(soup, corners[2]));
}

class HolePatcher {
 public:
  HolePatcher(CleanSoup& soup, const HoleOptions& options, HoleReport& report,
              ProgressObserver* progress)
      : soup_(soup),
        options_(options),
        report_(report),
        progress_(progress),
        triangles_(index_triangles(soup)),
        sheets_{DisjointSets(triangles_.size()), {}},
        parts_(0) {}

  void run() {
    {
      const EdgeTable table(triangles_);
      loops_ = internal::find_boundary_loops(soup_, triangles_, table, progress_);
      report_.loops = loops_.loops();
      report_.stray_edges = loops_.stray_edges;
      if (loops_.loops() == 0) return;
      flanges_ = internal::find_flanges(soup_, triangles_, table, loops_, progress_);
      flanges_.is_outer_rim.resize(loops_.loops() + flanges_.openings.loops(), 0);
      internal::append_loops(loops_, flanges_.openings);
      measure_sheets(table);
    }
    find_rims();
    triangulate();
    judge_openings();
    if (options_.rings) close_rings();
    if (!rings_.empty()) judge_openings();
    curve();
    add_points_of_curved();
    make_room();
    for (std::size_t l = 0; l < patches_.size(); ++l) close_hole(l);
    find_planes();
    drop_copies();
    report_.rings = rings_.size();
    report_.area *= soup_.grid.unit * soup_.grid.unit;
    report_.largest_area *= soup_.grid.unit * soup_.grid.unit;
  }

 private:
  void measure_sheets(const EdgeTable& table) {
    table.for_each_edge([&](std::span<const std::uint32_t> sides) {
      if (sides.size() == 2) sheets_.sets.join(sides[0] / 3, sides[1] / 3);
    });
    sheets_.area.assign(triangles_.size(), 0);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      sheets_.area[sheets_.sets.root(t)] += area_of(soup_, soup_.triangles[TriangleId(t)].corners);
    }
    parts_ = sheets_.sets;
    for (std::size_t l = 0; l < loops_.loops(); ++l) {
      for (const std::uint32_t e : loops_.edges_of(l)) {
        parts_.join(a_triangle_at(l), triangle_at(e));
      }
    }
  }

  // In grid steps: where the mesh is makes no difference.
  void find_rims() {
    rims_.resize(loops_.loops());
    for (std::size_t l = 0; l < rims_.size(); ++l) {
      for (const std::uint32_t p : loops_.points_of(l)) {
        rims_[l].points.push_back(position(soup_, PointId(p)));
      }
      for (const std::uint32_t e : loops_.edges_of(l)) {
        const std::uint32_t side = loops_.edges[e].side;
        const std::uint32_t third = side_start(triangles_, next_side(next_side(side)));
        rims_[l].apex.push_back(position(soup_, PointId(third)));
      }
    }
  }

  void triangulate() {
    std::vector<double> area(rims_.size());
    for (std::size_t l = 0; l < rims_.size(); ++l) area[l] = sheet_area(l, l);
    patches_.resize(rims_.size());
    folded_.assign(rims_.size(), 0);
    flat_.assign(rims_.size(), 0);
    too_large_.assign(rims_.size(), 0);
    closed_.assign(rims_.size(), 0);
    SharedProgress shared(progress_, rims_.size());
    parallel_for(rims_.size(), [&](std::size_t l) {
      LoopTriangulationOptions options;
      options.most_edges = options_.most_edges;
      options.poll = [&shared] { shared.poll(); };
      patches_[l] = internal::triangulate_loop(rims_[l], options);
      flat_[l] = internal::least_area(rims_[l]) >= kFlat * patches_[l].area ? 1 : 0;
      const bool is_large = patches_[l].area > (flat_[l] != 0 ? most(l) : kSmallPatch) * area[l];
      const bool is_rim = flanges_.is_outer_rim[l] != 0;
      folded_[l] = is_rim || (is_large && lies_on_surface(l)) ? 1 : 0;
      shared.done();
    });
    if (options_.sheets_stay_open) open_sheets(area);
  }

  void open_sheets(const std::vector<double>& area) {
    std::vector<internal::RimOfSheet> ends;
    for (std::size_t l = 0; l < rims_.size(); ++l) {
      ends.push_back({sheets_.sets.root(a_triangle_at(l)), area[l], patches_[l].area});
    }
    const std::vector<char> stays_open = internal::find_sheet_rims(rims_, ends);
    for (std::size_t l = 0; l < rims_.size(); ++l) folded_[l] |= stays_open[l];
  }

  void judge_openings() {
    too_large_ = find_large(options_.largest_share, options_.largest_flat_share);
  }

  // Patches of more than these shares of their parts, but for those that are closed or folded. The
  // rims that a sheet ends at, and the rings between two, make one part of sheets.
  std::vector<char> find_large(double most, double most_of_flat) {
    std::vector<double> area(triangles_.size(), 0);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      area[parts_.root(t)] += area_of(soup_, soup_.triangles[TriangleId(t)].corners);
    }
    for (const Ring& ring : rings_) area[parts_.root(a_triangle_at(ring.loop))] += ring.area;
    std::vector<std::size_t> loops;
    std::vector<internal::Opening> openings;
    for (std::size_t l = 0; l < rims_.size(); ++l) {
      if (closed_[l] != 0 || folded_[l] != 0) continue;
      loops.push_back(l);
      openings.push_back(
          {parts_.root(a_triangle_at(l)), patches_[l].area, flat_[l] != 0 ? most_of_flat : most});
    }
    const auto found = internal::find_large_openings(openings, std::move(area));
    std::vector<char> large(rims_.size(), 0);
    for (std::size_t i = 0; i < loops.size(); ++i) large[loops[i]] = found[i];
    return large;
  }

  // That a patch may have of the area of its part.
  [[nodiscard]] double most(std::size_t loop) const {
    return flat_[loop] != 0 ? options_.largest_flat_share : options_.largest_share;
  }

  [[nodiscard]] std::uint32_t triangle_at(std::uint32_t border_edge) const {
    return loops_.edges[border_edge].side / 3;
  }

  [[nodiscard]] std::uint32_t a_triangle_at(std::size_t loop) const {
    return triangle_at(loops_.edges_of(loop)[0]);
  }

  // Whether the patch is folded back at most of the open edges: it would be a copy of an open
  // sheet.
  [[nodiscard]] bool lies_on_surface(std::size_t loop) const {
    const Rim& rim = rims_[loop];
    const auto edges = loops_.edges_of(loop);
    std::size_t open = 0, sharp = 0;
    const auto look_at = [&](std::uint32_t from, std::uint32_t to, std::uint32_t third) {
      if ((from + 1) % rim.size() != to || !loops_.edges[edges[from]].open) return;
      ++open;
      sharp += internal::is_sharp_fold(rim, from, rim.points[third]);
    };
    for (const auto& [a, b, c] : patches_[loop].triangles) {
      look_at(a, b, c);
      look_at(b, c, a);
      look_at(c, a, b);
    }
    return 2 * sharp > open;
  }

  // Of the sheets that end at two loops, or at one that is given twice.
  double sheet_area(std::size_t loop, std::size_t other) {
    roots_.clear();
    for (const std::size_t l : {loop, other}) {
      for (const std::uint32_t e : loops_.edges_of(l)) {
        roots_.push_back(sheets_.sets.root(triangle_at(e)));
      }
    }
    std::sort(roots_.begin(), roots_.end());
    roots_.erase(std::unique(roots_.begin(), roots_.end()), roots_.end());
    double area = 0;
    for (const std::uint32_t root : roots_) area += sheets_.area[root];
    return area;
  }

  // Joins two rims by a ring where that takes less area than to close each of them.
  void close_rings() {
    for (const auto& pair : internal::find_facing_rims(rims_, progress_)) {
      const std::size_t a = pair.first, b = pair.second;
      if (progress_ != nullptr && progress_->cancelled()) throw Cancelled();
      if (flanges_.is_outer_rim[a] != 0 || flanges_.is_outer_rim[b] != 0) continue;
      if (rims_[a].size() * rims_[b].size() > kLargestRing) continue;
      if (std::max(share_of_sheets(a), share_of_sheets(b)) <= kMouth) continue;
      const std::array<FilledNotches, 2> filled = {internal::fill_notches(rims_[a]),
                                                   internal::fill_notches(rims_[b])};
      const StripTriangulation ring = internal::triangulate_strip(filled[0].rim, filled[1].rim);
      const double area = ring.area + filled[0].area + filled[1].area;
      if (ring.folded || area > options_.largest_share * sheet_area(a, b)) continue;
      if (area >= most_of_ring(a, b)) continue;
      if (!is_clear_gap(a, b) && area >= kNarrow * (patches_[a].area + patches_[b].area)) continue;
      closed_[a] = closed_[b] = 1;
      parts_.join(a_triangle_at(a), a_triangle_at(b));
      rings_.push_back({a, area});
      note_patch(2, area, std::max(rims_[a].size(), rims_[b].size()));
      add_all(a, filled[0].triangles);
      add_all(b, filled[1].triangles);
      const std::size_t first = filled[0].left.size();
      const auto id = [&](std::uint32_t i) {
        return i < first ? PointId(loops_.points_of(a)[filled[0].left[i]])
                         : PointId(loops_.points_of(b)[filled[1].left[i - first]]);
      };
      const bool turn = runs_along_surface(a);
      for (const auto& t : ring.triangles) add({id(t[0]), id(t[1]), id(t[2])}, turn);
    }
  }

  // What it may have in area. Two pieces of a surface have no patches, and are joined at any price.
  double most_of_ring(std::size_t a, std::size_t b) {
    const bool is_piece_a = is_most_of_its_sheets(a), is_piece_b = is_most_of_its_sheets(b);
    if (is_piece_a && is_piece_b) return std::numeric_limits<double>::infinity();
    if (!is_piece_a && !is_piece_b) return kWorthARing * (patches_[a].area + patches_[b].area);
    if (is_piece_a) std::swap(a, b);
    return kLargerThanPatch * patches_[a].area + sheet_area(b, b);
  }

  // Between two pieces of a surface, or the two walls of a vessel.
  bool is_clear_gap(std::size_t a, std::size_t b) {
    return std::max(share_of_sheets(a), share_of_sheets(b)) > kLargeOpening || are_two_walls(a, b);
  }

  // That the patch has, in area.
  double share_of_sheets(std::size_t loop) { return patches_[loop].area / sheet_area(loop, loop); }

  // Whether two sheets end at these rims, one of which lies within the bounds of the other.
  bool are_two_walls(std::size_t a, std::size_t b) {
    const std::uint32_t first = sheets_.sets.root(a_triangle_at(a));
    const std::uint32_t second = sheets_.sets.root(a_triangle_at(b));
    if (first == second) return false;
    if (sheet_boxes_.empty()) measure_sheet_boxes();
    return sheet_boxes_[first].contains(sheet_boxes_[second]) ||
           sheet_boxes_[second].contains(sheet_boxes_[first]);
  }

  void measure_sheet_boxes() {
    sheet_boxes_.resize(triangles_.size());
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      Eigen::AlignedBox3d& box = sheet_boxes_[sheets_.sets.root(t)];
      for (const std::uint32_t p : triangles_[t]) box.extend(position(soup_, PointId(p)));
    }
  }

  // A sheet, or a piece of a surface.
  bool is_most_of_its_sheets(std::size_t loop) {
    return patches_[loop].area > options_.largest_share * sheet_area(loop, loop);
  }

  void curve() {
    curved_.resize(rims_.size());
    if (options_.mode == HoleMode::flat) return;
    const std::vector<char> too_large = find_large(kLargestCurved, kLargestCurved);
    const std::vector<internal::Collar> collars = internal::find_collars(soup_, triangles_, loops_);
    Eigen::AlignedBox3d bounds;
    for (PointId p(0u); p < soup_.points.end_id(); ++p.value) bounds.extend(position(soup_, p));
    SharedProgress shared(progress_, rims_.size());
    parallel_for(rims_.size(), [&](std::size_t l) {
      if (closed_[l] == 0 && is_patched(l) && too_large[l] == 0) {
        const bool anywhere = options_.mode == HoleMode::curved;
        curved_[l] = internal::curve_patch(rims_[l], patches_[l], collars[l], anywhere,
                                           [&] { shared.poll(); });
        if (!anywhere && curved_[l] && leaves(*curved_[l], rims_[l], bounds)) curved_[l].reset();
      }
      shared.done();
    });
  }

  // Whether it would make the bounds larger by more than a share of its rim's width.
  [[nodiscard]] static bool leaves(const internal::PatchMesh& patch, const Rim& rim,
                                   const Eigen::AlignedBox3d& bounds) {
    Eigen::AlignedBox3d larger = bounds, own;
    for (const Vec3d& p : rim.points) own.extend(p);
    for (const Vec3d& p : patch.points) larger.extend(p);
    return (larger.sizes() - bounds.sizes()).maxCoeff() > kMostGrowth * own.sizes().maxCoeff();
  }

  [[nodiscard]] bool is_patched(std::size_t loop) const {
    return too_large_[loop] == 0 && folded_[loop] == 0;
  }

  // All at once: to look each up in a table of all points would be slow.
  void add_points_of_curved() {
    std::vector<Vec3d> places;
    for (std::size_t l = 0; l < curved_.size(); ++l) {
      first_point_.push_back(places.size());
      if (!curved_[l]) continue;
      const auto& points = curved_[l]->points;
      for (std::size_t i = rims_[l].size(); i < points.size(); ++i) places.push_back(points[i]);
    }
    new_points_ = internal::add_points(soup_, places);
  }

  // For what is added at most: growing step by step would take room for half of the soup again.
  void make_room() {
    std::size_t added = 0;
    for (std::size_t l = 0; l < patches_.size(); ++l) {
      if (closed_[l] != 0 || !is_patched(l)) continue;
      added += curved_[l] ? curved_[l]->triangles.size() : patches_[l].triangles.size();
    }
    soup_.triangles.reserve(soup_.triangles.size() + added);
  }

  void close_hole(std::size_t loop) {
    if (closed_[loop] != 0) return;
    if (curved_[loop]) return close_curved(loop);
    const LoopTriangulation& patch = patches_[loop];
    if (!is_patched(loop)) {
      ++report_.too_large;
      return;
    }
    const std::size_t before = soup_.triangles.size();
    add_all(loop, patch.triangles);
    if (soup_.triangles.size() == before) {
      ++report_.slits;
    } else {
      note_patch(1, patch.area, rims_[loop].size());
    }
  }

  void close_curved(std::size_t loop) {
    const internal::PatchMesh& patch = *curved_[loop];
    std::vector<PointId> ids;
    for (const std::uint32_t p : loops_.points_of(loop)) ids.emplace_back(p);
    for (std::size_t i = 0; ids.size() < patch.points.size(); ++i) {
      ids.push_back(new_points_[first_point_[loop] + i]);
    }
    const bool turn = runs_along_surface(loop);
    double area = 0;
    for (const auto& t : patch.triangles) {
      add({ids[t[0]], ids[t[1]], ids[t[2]]}, turn);
      area += internal::triangle_area(patch.points[t[0]], patch.points[t[1]], patch.points[t[2]]);
    }
    ++report_.curved;
    note_patch(1, area, rims_[loop].size());
  }

  void note_patch(std::size_t loops, double area, std::size_t longest) {
    report_.closed += loops;
    report_.area += area;
    report_.largest_area = std::max(report_.largest_area, area);
    report_.longest_loop = std::max(report_.longest_loop, longest);
  }

  // Between points of the loop, in its direction.
  void add_all(std::size_t loop, std::span<const std::array<std::uint32_t, 3>> triangles) {
    const auto ids = loops_.points_of(loop);
    const bool turn = runs_along_surface(loop);
    for (const auto& t : triangles) {
      add({PointId(ids[t[0]]), PointId(ids[t[1]]), PointId(ids[t[2]])}, turn);
    }
  }

  void add(CornerIds corners, bool turn) {
    if (turn) std::swap(corners[1], corners[2]);
    const auto& at = soup_.grid_points;
    const Plane plane = plane_through(at[corners[0]], at[corners[1]], at[corners[2]]);
    // Three points in a line need no triangle: the edge across bounds the same region.
    if (is_null(plane)) return;
    planes_.push_back(plane);
    soup_.triangles.push_back({corners, PlaneId(), 1, Triangle::kNoSource});
  }

  // Of all triangles that were added.
  void find_planes() {
    const auto interned = soup_.planes.intern(std::move(planes_));
    for (std::size_t i = 0; i < interned.size(); ++i) {
      Triangle& triangle = soup_.triangles[TriangleId(triangles_.size() + i)];
      triangle.plane = interned[i].id;
      triangle.winding = interned[i].turned ? -1 : 1;
    }
  }

  // Most of the triangles at the loop pass it in its own direction, so that a patch has to turn.
  [[nodiscard]] bool runs_along_surface(std::size_t loop) const {
    const auto ids = loops_.points_of(loop);
    const auto edges = loops_.edges_of(loop);
    std::size_t same = 0;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      same += side_start(triangles_, loops_.edges[edges[i]].side) == ids[i];
    }
    return 2 * same > ids.size();
  }

  // A patch may be a triangle that is there already, as where a single triangle juts into the hole,
  // or one of another patch. There is to be one of each: two the same way round are one, and two
  // that face each other have no orientation.
  void drop_copies() {
    const std::size_t given = triangles_.size();
    std::vector<char> at_loop(soup_.points.size(), 0);
    for (const std::uint32_t p : loops_.point) at_loop[p] = 1;
    std::vector<std::pair<CornerIds, std::uint32_t>> keys;
    for (TriangleId t(0u); t < soup_.triangles.end_id(); ++t.value) {
      const CornerIds& corners = soup_.triangles[t].corners;
      if (std::all_of(corners.begin(), corners.end(),
                      [&](PointId p) { return at_loop[p.index()] != 0; })) {
        keys.emplace_back(internal::sorted_corners(corners), t.value);
      }
    }
    std::sort(keys.begin(), keys.end());
    std::vector<char> dropped(soup_.triangles.size(), 0);
    for (std::size_t i = 1; i < keys.size(); ++i) {
      if (keys[i].first != keys[i - 1].first) continue;
      Triangle& first = soup_.triangles[TriangleId(keys[i - 1].second)];
      if (first.winding != soup_.triangles[TriangleId(keys[i].second)].winding) first.winding = 0;
      dropped[keys[i].second] = 1;
      keys[i].second = keys[i - 1].second;
    }
    std::size_t kept = given;
    for (std::size_t t = given; t < soup_.triangles.size(); ++t) {
      if (dropped[t] == 0) soup_.triangles[TriangleId(kept++)] = soup_.triangles[TriangleId(t)];
    }
    soup_.triangles.resize(kept);
    report_.triangles = kept - given;
  }

  CleanSoup& soup_;
  const HoleOptions& options_;
  HoleReport& report_;
  ProgressObserver* progress_;
  std::vector<IndexTriangle> triangles_;
  Sheets sheets_;
  DisjointSets parts_;  // of triangles: sheets that are joined by rims and rings
  std::vector<Eigen::AlignedBox3d> sheet_boxes_;  // of each root
  std::vector<Ring> rings_;
  BoundaryLoops loops_;
  internal::Flanges flanges_;
  std::vector<Rim> rims_;                                   // of each loop
  std::vector<LoopTriangulation> patches_;                  // of each loop
  std::vector<char> folded_;                                // of each loop: a rim of an open sheet
  std::vector<char> flat_;                                  // of each loop: its patch
  std::vector<char> too_large_;                             // of each loop: its patch
  std::vector<char> closed_;                                // of each loop: by a ring
  std::vector<std::optional<internal::PatchMesh>> curved_;  // of each loop
  std::vector<std::size_t> first_point_;                    // of each loop, in new_points_
  std::vector<PointId> new_points_;                         // of curved patches
  std::vector<Plane> planes_;                               // of the triangles that were added
  std::vector<std::uint32_t> roots_;                        // scratch
};

}  // namespace

std::string_view hole_mode_name(HoleMode mode) {
  switch (mode) {
    case HoleMode::patch:
      return "patch";
    case HoleMode::curved:
      return "curved";
    case HoleMode::flat:
      return "flat";
    case HoleMode::extend:
      return "extend";
    case HoleMode::none:
      return "none";
  }
  return "";
}

void patch_holes(CleanSoup& soup, const HoleOptions& options, HoleReport& report,
                 ProgressObserver* progress) {
  report = {};
  const bool is_share = options.largest_share >= 0 && options.largest_flat_share >= 0;
  if (!is_share) throw UsageError("the largest hole must be 0 or more");
  if (options.mode == HoleMode::extend || options.mode == HoleMode::none) return;
  HolePatcher(soup, options, report, progress).run();
}

}  // namespace meshrepair
