// SPDX-License-Identifier: MIT
#include "page/distance_page.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <check/point_distances.h>
#include <mesh/split_edges.h>

namespace meshrepair {
namespace {

// As finely as the eye sees: of the diagonal, and no more triangles than this are made for it.
constexpr double kLongestEdge = 0.01;
constexpr std::size_t kMostDivided = 200'000;
// Of a value in the page: the top of the scale.
constexpr double kMostValue = 4095;

struct DrawnDistances {
  DrawnMesh drawn;
  std::vector<double> distances;  // of its points
};

DrawnDistances drawn_distances(const DistancePage& page, const TriangleSoup& soup,
                               const TriangleSoup& other, std::size_t most, Run& run) {
  DrawnDistances all;
  all.drawn = drawn_mesh(soup, {}, {}, most);
  all.drawn.soup = split_edges(std::move(all.drawn.soup), kLongestEdge * page.distance.diagonal,
                               std::min(most, all.drawn.soup.triangles.size() + kMostDivided));
  all.distances = point_distances(all.drawn.soup.points, other, &run.progress);
  return all;
}

std::vector<std::uint32_t> values_of(const std::vector<double>& distances, double most) {
  std::vector<std::uint32_t> values;
  values.reserve(distances.size());
  for (const double distance : distances) {
    const double share = most > 0 && std::isfinite(most) ? std::min(distance / most, 1.0) : 0;
    values.push_back(static_cast<std::uint32_t>(std::lround(share * kMostValue)));
  }
  return values;
}

Json way_of(const OneSidedDistance& way, const PageGrid& grid) {
  Json bound = nullptr;
  if (way.bound) bound = *way.bound;
  return {{"mean", way.mean}, {"rms", way.rms},         {"largest", way.largest},
          {"bound", bound},   {"samples", way.samples}, {"at", grid.steps_of(way.at)}};
}

double largest_of(const std::vector<double>& list, double least) {
  return std::accumulate(list.begin(), list.end(), least,
                         [](double a, double b) { return std::max(a, b); });
}

ShownMesh shown(std::string_view role, const DistancePage::Mesh& mesh, DrawnDistances distances,
                double most) {
  ShownMesh shown{role, mesh.name, mesh.soup, std::nullopt};
  shown.drawn = std::move(distances.drawn);
  shown.drawn->values = values_of(distances.distances, most);
  return shown;
}

}  // namespace

void write_distance_page_stage(const HtmlRequest& request, DistancePage page, Run& run) {
  if (!request.wanted()) return;
  run.progress.stage("html");
  const TriangleSoup &a = page.a.soup, &b = page.b.soup;
  DrawnDistances forth = drawn_distances(page, a, b, request.most_triangles, run);
  DrawnDistances back = drawn_distances(page, b, a, request.most_triangles, run);
  // A point that is drawn may be farther than all samples.
  const double most =
      largest_of(forth.distances, largest_of(back.distances, page.distance.largest()));
  PageContent content{"distance", page.up, page.unit};
  content.meshes.push_back(shown("a", page.a, std::move(forth), most));
  content.meshes.push_back(shown("b", page.b, std::move(back), most));
  const PageGrid grid = grid_of(content.meshes);
  content.more = {{"scale", {{"most", most}, {"steps", kMostValue}}},
                  {"ways", {way_of(page.distance.forth, grid), way_of(page.distance.back, grid)}}};
  content.report = std::move(page.report);
  write_page(request, std::move(content), run);
}

}  // namespace meshrepair
