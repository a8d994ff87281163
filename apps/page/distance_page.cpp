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

DrawnMesh divided_mesh(double diagonal, const TriangleSoup& soup, std::size_t most) {
  DrawnMesh drawn = drawn_mesh(soup, {}, {}, most);
  drawn.soup = split_edges(std::move(drawn.soup), kLongestEdge * diagonal,
                           std::min(most, drawn.soup.triangles.size() + kMostDivided));
  return drawn;
}

DrawnDistances with_distances(DrawnMesh drawn, const TriangleSoup& other, Run& run) {
  DrawnDistances all{std::move(drawn), {}};
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
  const TriangleSoup& a = page.a.soup;
  const double diagonal = page.others.front().distance.diagonal;  // of A
  const DrawnMesh divided_a = divided_mesh(diagonal, a, request.most_triangles);
  std::vector<DrawnDistances> drawn;  // A and the other, of each pair
  double most = 0;
  for (const auto& [b, distance] : page.others) {
    drawn.push_back(with_distances(divided_a, b.soup, run));
    drawn.push_back(with_distances(divided_mesh(diagonal, b.soup, request.most_triangles), a, run));
    most = std::max(most, distance.largest());
  }
  // A point that is drawn may be farther than all samples.
  for (const DrawnDistances& one : drawn) most = largest_of(one.distances, most);
  PageContent content{"distance", page.up, page.unit};
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const bool is_a = i % 2 == 0;
    content.meshes.push_back(
        shown(is_a ? "a" : "b", is_a ? page.a : page.others[i / 2].b, std::move(drawn[i]), most));
  }
  const PageGrid grid = grid_of(content.meshes);
  Json ways = Json::array();
  for (const auto& [b, distance] : page.others) {
    ways.push_back(way_of(distance.forth, grid));
    ways.push_back(way_of(distance.back, grid));
  }
  content.more = {{"scale", {{"most", most}, {"steps", kMostValue}}}, {"ways", ways}};
  content.report = std::move(page.report);
  write_page(request, std::move(content), run);
}

}  // namespace meshrepair
