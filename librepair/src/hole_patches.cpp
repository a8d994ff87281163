#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <tbb/parallel_for.h>

#include <bsp/disjoint_sets.h>
#include <bsp/edge_table.h>
#include <bsp/error.h>
#include <bsp/shared_progress.h>
#include <repair/hole_patches.h>
#include <repair/orient_parts.h>

#include "boundary_loops.h"
#include "loop_triangulation.h"

namespace meshrepair {
namespace {

using internal::BoundaryLoops;
using internal::LoopTriangulation;
using internal::LoopTriangulationOptions;
using Corners = std::array<PointId, 3>;

struct Sheets {
  DisjointSets sets;         // of triangles, joined where two meet at an edge
  std::vector<double> area;  // of each root, in square grid steps
};

Vec3d position(const CleanSoup& soup, PointId p) {
  const GridPoint& at = soup.grid_points[p];
  return {static_cast<double>(at.x), static_cast<double>(at.y), static_cast<double>(at.z)};
}

double area_of(const CleanSoup& soup, const Corners& corners) {
  const Vec3d a = position(soup, corners[0]);
  return 0.5 * (position(soup, corners[1]) - a).cross(position(soup, corners[2]) - a).norm();
}

Corners sorted(Corners corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
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
        sheets_{DisjointSets(triangles_.size()), {}} {}

  void run() {
    {
      const EdgeTable table(triangles_);
      loops_ = internal::find_boundary_loops(soup_, triangles_, table, progress_);
      report_.loops = loops_.loops();
      report_.stray_edges = loops_.stray_edges;
      if (loops_.loops() == 0) return;
      measure_sheets(table);
    }
    std::vector<LoopTriangulation> patches(loops_.loops());
    triangulate(patches);
    for (std::size_t l = 0; l < patches.size(); ++l) add(l, patches[l]);
    drop_copies();
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
  }

  // Of the sheets that end at this loop.
  double area_around(std::size_t loop) {
    roots_.clear();
    for (const std::uint32_t e : loops_.edges_of(loop)) {
      roots_.push_back(sheets_.sets.root(loops_.edges[e].side / 3));
    }
    std::sort(roots_.begin(), roots_.end());
    double area = 0;
    for (std::size_t i = 0; i < roots_.size(); ++i) {
      if (i == 0 || roots_[i] != roots_[i - 1]) area += sheets_.area[roots_[i]];
    }
    return area;
  }

  void triangulate(std::vector<LoopTriangulation>& patches) {
    std::vector<double> allowed(patches.size());
    for (std::size_t l = 0; l < patches.size(); ++l) {
      allowed[l] = options_.largest_share * area_around(l);
    }
    SharedProgress shared(progress_, patches.size());
    tbb::parallel_for(std::size_t{0}, patches.size(), [&](std::size_t l) {
      patches[l] = triangulate(l, allowed[l], shared);
      shared.done();
    });
  }

  // In coordinates relative to the loop, so that the choice does not depend on where the mesh is.
  LoopTriangulation triangulate(std::size_t loop, double allowed, SharedProgress& shared) const {
    const auto ids = loops_.points_of(loop);
    const auto edges = loops_.edges_of(loop);
    const Vec3d base = position(soup_, PointId(ids[0]));
    std::vector<Vec3d> points, apex;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      points.push_back(position(soup_, PointId(ids[i])) - base);
      const std::uint32_t side = loops_.edges[edges[i]].side;
      const std::uint32_t third = side_start(triangles_, next_side(next_side(side)));
      apex.push_back(position(soup_, PointId(third)) - base);
    }
    LoopTriangulation patch;
    patch.too_large = internal::least_area(points) > allowed;
    if (patch.too_large) return patch;
    LoopTriangulationOptions options;
    options.most_edges = options_.most_edges;
    options.largest_area = allowed;
    options.poll = [&shared] { shared.poll(); };
    return internal::triangulate_loop(points, apex, options);
  }

  void add(std::size_t loop, const LoopTriangulation& patch) {
    if (patch.too_large) {
      ++report_.too_large;
      return;
    }
    ++report_.closed;
    report_.area += patch.area;
    report_.largest_area = std::max(report_.largest_area, patch.area);
    const auto ids = loops_.points_of(loop);
    report_.longest_loop = std::max(report_.longest_loop, ids.size());
    const bool along = runs_along_surface(loop);
    for (const auto& t : patch.triangles) {
      Corners corners = {PointId(ids[t[0]]), PointId(ids[t[1]]), PointId(ids[t[2]])};
      if (along) std::swap(corners[1], corners[2]);
      const auto& at = soup_.grid_points;
      Plane plane = plane_through(at[corners[0]], at[corners[1]], at[corners[2]]);
      // Three points in a line need no triangle: the edge across bounds the same region.
      if (is_null(plane)) continue;
      const auto interned = soup_.planes.intern(plane);
      soup_.triangles.push_back(
          {corners, interned.id, interned.turned ? -1 : 1, Triangle::kNoSource});
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
    std::vector<std::pair<Corners, std::uint32_t>> keys;
    for (TriangleId t(0u); t < soup_.triangles.end_id(); ++t.value) {
      const Corners& corners = soup_.triangles[t].corners;
      if (std::all_of(corners.begin(), corners.end(),
                      [&](PointId p) { return at_loop[p.index()] != 0; })) {
        keys.emplace_back(sorted(corners), t.value);
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
  BoundaryLoops loops_;
  std::vector<std::uint32_t> roots_;  // scratch
};

}  // namespace

std::string_view hole_mode_name(HoleMode mode) {
  switch (mode) {
    case HoleMode::patch:
      return "patch";
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
  if (!(options.largest_share >= 0)) throw UsageError("the largest hole is to be 0 or more");
  if (options.mode != HoleMode::patch) return;
  HolePatcher(soup, options, report, progress).run();
}

}  // namespace meshrepair
