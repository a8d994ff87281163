// SPDX-License-Identifier: MIT
#include "chamber_surface.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include <check/self_intersections.h>
#include <extract/arrange.h>
#include <mesh/internal/triangle_measures.h>
#include <mesh/topology.h>
#include <repair/chamber_graph.h>
#include <repair/inside_rule.h>

#include "slits/fill_slits.h"

namespace meshrepair::internal {
namespace {

// Of the surface, how much may lie in slits and fins, or contradict the winding numbers: little
// slivers are no reason for cells.
constexpr double kLittleOfSurface = 1e-3;

// So many pieces tell whether there are slits.
constexpr std::size_t kMostPieces = 1024;

double area_of_triangle(const TriangleSoup& mesh, std::uint32_t t) {
  const auto& c = mesh.triangles[t];
  return triangle_area(mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]]);
}

double area_of_triangles(const TriangleSoup& mesh, std::span<const std::uint32_t> list) {
  double sum = 0;
  for (const std::uint32_t t : list) sum += area_of_triangle(mesh, t);
  return sum;
}

// Evenly chosen ones.
std::vector<std::uint32_t> some_of(std::span<const std::uint32_t> list, std::size_t most) {
  std::vector<std::uint32_t> some;
  const std::size_t step = list.size() / most + 1;
  for (std::size_t i = 0; i < list.size(); i += step) some.push_back(list[i]);
  return some;
}

// Whether pieces of triangles lie so near to each other that all cells would fill what is between,
// as far as some of them tell.
bool has_slits(const CleanSoup& soup, const Surface& surface, const RepairOptions& options) {
  if (options.slit_steps <= 0) return false;
  const TriangleSoup& mesh = surface.mesh;
  const std::vector<char> whole = find_whole_triangles(soup, surface);
  std::vector<std::uint32_t> pieces;
  for (std::uint32_t t = 0; t < whole.size(); ++t) {
    if (whole[t] == 0) pieces.push_back(t);
  }
  const std::vector<std::uint32_t> some = some_of(pieces, kMostPieces);
  CancelOnly quiet(options.progress);
  SelfIntersectionOptions near;
  near.nearness = widest_slit(soup, options) * soup.grid.unit;
  near.most_pairs = mesh.triangles.size();
  near.progress = &quiet;
  double area = 0;
  for (const auto& [a, b] : self_intersections(mesh, some, near).pairs) {
    area += std::min(area_of_triangle(mesh, a), area_of_triangle(mesh, b));
  }
  const double share_of_pieces = area_of_triangles(mesh, pieces) / surface_area(mesh);
  return area * share_of_pieces > kLittleOfSurface * area_of_triangles(mesh, some);
}

class ChamberSurface {
 public:
  ChamberSurface(const CleanSoup& soup, const Orientation& orientation,
                 const RepairOptions& options, RepairReport& report, StageMeter& meter)
      : soup_(soup), orientation_(orientation), options_(options), report_(report), meter_(meter) {}

  std::optional<Surface> run() {
    meter_.begin("arrange");
    const std::optional<Arrangement> arrangement =
        Arrangement::make(soup_, report_.arrange, options_.progress);
    if (!arrangement) return std::nullopt;
    meter_.begin("inside");
    const std::optional<std::vector<char>> solid = label(*arrangement);
    if (!solid) return std::nullopt;
    meter_.begin("extract");
    return boundary_of_chambers(soup_, *arrangement, *solid, options_, report_);
  }

 private:
  std::optional<std::vector<char>> label(const Arrangement& arrangement) {
    const CellGraph graph = graph_of_chambers(arrangement, soup_, orientation_);
    report_.links = graph.links().size();
    InsideOptions inside = options_.inside;
    inside.solve.progress = options_.progress;
    inside.least_solid_area /= soup_.grid.unit * soup_.grid.unit;
    CellLabels labels = label_cells(graph, orientation_, inside, report_.inside);
    if (may_bound_more()) return std::nullopt;
    report_.lost_area = lost_area(graph, labels.solid) * soup_.grid.unit * soup_.grid.unit;
    return std::move(labels.solid);
  }

  // Together with surface that is made up, triangles that contradict each other, and sheets with
  // the same chamber on both sides, may bound what is in no chamber of its own.
  [[nodiscard]] bool may_bound_more() const {
    const InsideReport& inside = report_.inside;
    if (!inside.exact && inside.used != InsideRule::winding) return true;
    return inside.loose_share + inside.winding_contradiction > kLittleOfSurface;
  }

  const CleanSoup& soup_;
  const Orientation& orientation_;
  const RepairOptions& options_;
  RepairReport& report_;
  StageMeter& meter_;
};

}  // namespace

std::optional<Surface> boundary_of_chambers(const CleanSoup& soup, const Arrangement& arrangement,
                                            const std::vector<char>& solid,
                                            const RepairOptions& options, RepairReport& report) {
  ExtractOptions extract = options.extract;
  extract.progress = options.progress;
  std::optional<Arrangement::Boundary> boundary =
      arrangement.boundary(solid, extract, report.arrange);
  if (!boundary || boundary->surface.mesh.triangles.empty()) return std::nullopt;
  if (has_slits(soup, boundary->surface, options)) return std::nullopt;
  report.parts = find_part_fates(soup, boundary->places);
  return std::move(boundary->surface);
}

std::optional<Surface> surface_of_chambers(const CleanSoup& soup, const Orientation& orientation,
                                           const RepairOptions& options, RepairReport& report,
                                           StageMeter& meter) {
  return ChamberSurface(soup, orientation, options, report, meter).run();
}

}  // namespace meshrepair::internal
