// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include <Eigen/Geometry>

#include <base/parallel.h>
#include <check/self_intersections.h>
#include <extract/arrange.h>

#include "arranged_facets.h"
#include "arranged_points.h"
#include "chambers.h"
#include "cut_set.h"
#include "kept_facets.h"
#include "region_facets.h"
#include "sheet_edges.h"
#include "sheet_surface.h"
#include "stacks.h"

namespace meshrepair {
namespace {

// For each triangle; of more, nearly all triangles meet nearly all others.
constexpr std::size_t kPairsEach = 64;

constexpr std::size_t kMeasuresPerTask = 4096;

// All that meet in more than corners and edges that they share, unless these are too many.
std::optional<std::vector<internal::CutSet::Pair>> find_pairs(const CleanSoup& soup,
                                                              ProgressObserver* progress) {
  TriangleSoup mesh;
  mesh.points.reserve(soup.points.size());
  mesh.triangles.reserve(soup.triangles.size());
  for (const GridPoint& p : soup.grid_points) mesh.points.push_back(as_vector(p));
  for (const Triangle& t : soup.triangles) {
    mesh.triangles.push_back({t.corners[0].value, t.corners[1].value, t.corners[2].value});
  }
  SelfIntersectionOptions options;
  options.weld = false;
  options.most_pairs = kPairsEach * soup.triangles.size();
  options.progress = progress;
  SelfIntersections found = self_intersections(mesh, options);
  if (found.pairs.size() < found.count) return std::nullopt;
  return std::move(found.pairs);
}

}  // namespace

struct Arrangement::State {
  State(const CleanSoup& soup_in, std::span<const internal::CutSet::Pair> pairs)
      : soup(soup_in), cut(soup_in, pairs) {}

  [[nodiscard]] Vec3d place(std::uint32_t point) const {
    const auto at = points->at(point).position;
    return {at[0], at[1], at[2]};
  }
  [[nodiscard]] std::array<Vec3d, 3> places(std::uint32_t f) const {
    const IndexTriangle& c = sheets.corners[f];
    return {place(c[0]), place(c[1]), place(c[2])};
  }
  // `area`: that of the facet.
  [[nodiscard]] ChamberWall wall(std::uint32_t f, double area) const {
    const bool along = internal::corner_side(soup, sheets.triangle[f]) > 0;
    const std::uint32_t front = chambers.front[f], behind = chambers.behind[f];
    return {along ? behind : front, along ? front : behind, sheets.triangle[f], area};
  }
  // measure(a, b, c) of the corners of each facet.
  template <class Measure>
  [[nodiscard]] std::vector<double> measures(const Measure& measure) const {
    std::vector<double> all(sheets.size());
    parallel_tasks(all.size(), kMeasuresPerTask,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     for (std::size_t f = first; f < last; ++f) {
                       const auto [a, b, c] = places(static_cast<std::uint32_t>(f));
                       all[f] = measure(a, b, c);
                     }
                   });
    return all;
  }

  const CleanSoup& soup;
  internal::CutSet cut;
  std::optional<internal::ArrangedPoints> points;
  internal::Sheets sheets;
  std::optional<internal::SheetEdges> edges;
  std::optional<internal::Stacks> stacks;
  internal::Chambers chambers;
};

Arrangement::Arrangement(std::unique_ptr<State> state) : state_(std::move(state)) {}
Arrangement::Arrangement(Arrangement&&) noexcept = default;
Arrangement& Arrangement::operator=(Arrangement&&) noexcept = default;
Arrangement::~Arrangement() = default;

std::optional<Arrangement> Arrangement::make(const CleanSoup& soup, ArrangeReport& report,
                                             ProgressObserver* progress) {
  const auto pairs = find_pairs(soup, progress);
  if (!pairs) return std::nullopt;
  auto parts = std::make_unique<State>(soup, *pairs);
  report = {};
  report.cut_triangles = parts->cut.size();
  {
    const auto facets = internal::arrange_facets(parts->cut, *pairs, parts->points, progress);
    if (!facets) return std::nullopt;
    report.facets = facets->corners.size();
    parts->sheets = internal::join_sheets(parts->cut, *facets, *parts->points);
  }
  report.new_points = parts->points->size() - parts->points->first_new();
  parts->edges.emplace(parts->cut, *parts->points, parts->sheets, progress);
  parts->stacks.emplace(parts->sheets, *parts->edges);
  auto chambers = internal::find_chambers(parts->cut, *parts->points, parts->sheets, *parts->edges,
                                          *parts->stacks, progress);
  if (!chambers) return std::nullopt;
  parts->chambers = std::move(*chambers);
  report.chambers = parts->chambers.count;
  return Arrangement(std::move(parts));
}

std::size_t Arrangement::chambers() const { return state_->chambers.count; }

std::vector<double> Arrangement::volumes() const {
  std::vector<double> volumes(chambers(), 0);
  const std::vector<double> moments =
      state_->measures([](const Vec3d& a, const Vec3d& b, const Vec3d& c) -> double {
        return a.dot(b.cross(c)) / 6;
      });
  for (std::uint32_t f = 0; f < moments.size(); ++f) {
    volumes[state_->chambers.behind[f]] += moments[f];
    volumes[state_->chambers.front[f]] -= moments[f];
  }
  return volumes;
}

// Facets that are in no stack in their order, then those of the lowest triangle of each stack.
std::vector<ChamberWall> Arrangement::walls() const {
  const std::vector<double> areas =
      state_->measures([](const Vec3d& a, const Vec3d& b, const Vec3d& c) -> double {
        return 0.5 * (b - a).cross(c - a).norm();
      });
  std::vector<ChamberWall> walls;
  walls.reserve(areas.size());
  for (std::uint32_t f = 0; f < state_->sheets.size(); ++f) {
    if (!state_->stacks->contains(f)) walls.push_back(state_->wall(f, areas[f]));
  }
  state_->stacks->for_each([&](std::span<const std::uint32_t> stack) {
    const std::uint32_t above = state_->wall(stack.back(), 0).above;
    for (const std::uint32_t f : stack) {
      if (state_->sheets.triangle[f] != state_->sheets.triangle[stack.front()]) break;
      walls.push_back(state_->wall(f, areas[f]));
      walls.back().above = above;
    }
  });
  return walls;
}

std::vector<Arrangement::Layer> Arrangement::layers() const {
  std::vector<Layer> layers;
  std::uint32_t wall = 0;
  for (std::uint32_t f = 0; f < state_->sheets.size(); ++f)
    wall += state_->stacks->contains(f) ? 0 : 1;
  state_->stacks->for_each([&](std::span<const std::uint32_t> stack) {
    const auto triangle = [&](std::uint32_t f) { return state_->sheets.triangle[f]; };
    for (std::size_t i = 0; i < stack.size() && triangle(stack[i]) == triangle(stack[0]); ++i) {
      for (std::size_t k = 1; k < stack.size(); ++k) {
        const bool is_another = triangle(stack[k]) != triangle(stack[k - 1]);
        if (is_another) layers.push_back({wall, triangle(stack[k])});
      }
      ++wall;
    }
  });
  return layers;
}

std::optional<Arrangement::Faces> Arrangement::faces(std::span<const std::uint32_t> region,
                                                     ProgressObserver* progress) const {
  const internal::RegionFacets facets = internal::keep_facets_between(
      state_->soup, state_->sheets, *state_->edges, *state_->stacks, state_->chambers, region);
  auto made = internal::make_sheet_faces(state_->cut, *state_->points, state_->sheets,
                                         *state_->edges, facets.kept, progress);
  if (!made) return std::nullopt;
  Faces faces;
  faces.surface = std::move(made->surface);
  for (const std::uint32_t f : made->facet) faces.regions.push_back(facets.regions[f]);
  return faces;
}

std::optional<Arrangement::Boundary> Arrangement::boundary(const std::vector<char>& solid,
                                                           const ExtractOptions& options,
                                                           ArrangeReport& report) const {
  internal::KeptFacets kept =
      internal::keep_facets(state_->soup, state_->sheets, *state_->edges, *state_->stacks,
                            state_->chambers, solid, options.touching);
  if (!kept.closed) return std::nullopt;
  report.singular_edges = kept.singular_edges;
  report.regions = 0;
  std::optional<Surface> surface = internal::make_sheet_surface(
      state_->cut, *state_->points, state_->sheets, *state_->edges, kept, options, report);
  if (!surface) return std::nullopt;
  return Boundary{std::move(*surface), std::move(kept.places)};
}

}  // namespace meshrepair
