// SPDX-License-Identifier: MIT
#include "boolean_chambers.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <extract/arrange.h>
#include <repair/chamber_graph.h>
#include <repair/inside_rule.h>

#include "join_soups.h"
#include "operands.h"

namespace meshrepair::internal {
namespace {

using Windings = IdVector<TriangleId, std::int32_t>;

// All solids as one soup, and how each of them has its triangles turned; 0 where it has none.
struct JoinedSolids {
  CleanSoup soup;
  std::vector<Windings> windings;
};

Windings moved(const Windings& windings, const IdVector<TriangleId, TriangleId>& to,
               std::size_t count) {
  Windings result(count, 0);
  for (TriangleId t(0u); t < windings.end_id(); ++t.value) result[to[t]] = windings[t];
  return result;
}

JoinedSolids join(JoinedSolids first, JoinedSolids second, std::uint32_t second_source) {
  JoinMap map;
  JoinedSolids joined;
  joined.soup = join_soups(first.soup, second.soup, second_source, map);
  const std::size_t count = joined.soup.triangles.size();
  for (const Windings& w : first.windings) {
    joined.windings.push_back(moved(w, map.first_triangle, count));
  }
  for (const Windings& w : second.windings) {
    joined.windings.push_back(moved(w, map.second_triangle, count));
  }
  return joined;
}

// In halves, so that each triangle is joined a few times only.
JoinedSolids join_all(std::vector<JoinedSolids>& solids, std::span<const std::uint32_t> source,
                      std::size_t first, std::size_t count) {
  if (count == 1) return std::move(solids[first]);
  const std::size_t left = count / 2;
  JoinedSolids a = join_all(solids, source, first, left);
  JoinedSolids b = join_all(solids, source, first + left, count - left);
  return join(std::move(a), std::move(b), source[first + left] - source[first]);
}

// Triangles that the same solids have, turned alike, are one part: that is all that the graph needs
// to know of parts.
Orientation orientation_of(const JoinedSolids& solids) {
  Orientation orientation;
  std::map<std::vector<std::int32_t>, std::uint32_t> parts;
  std::vector<std::int32_t> key(solids.windings.size());
  for (TriangleId t(0u); t < solids.soup.triangles.end_id(); ++t.value) {
    for (std::size_t k = 0; k < key.size(); ++k) key[k] = solids.windings[k][t];
    const auto part = parts.emplace(key, static_cast<std::uint32_t>(parts.size())).first->second;
    orientation.part_of.push_back(part);
    orientation.winding.push_back(solids.windings[0][t]);
  }
  return orientation;
}

// Which chambers or cells the operation makes solid. What rounding to the common grid turned inside
// out, or laid over each other, is as small as that: it winds otherwise than solids do, and is
// solid where it winds around. Empty if `exact` is asked for and windings contradict each other.
std::vector<char> combine_regions(CellGraph& graph, std::span<const TriangleSoup> given,
                                  const JoinedSolids& solids, SetOperation operation, bool exact,
                                  const BooleanOptions& options) {
  InsideOptions inside;
  inside.rule = InsideRule::winding;
  inside.solve.progress = options.repair.progress;
  std::vector<Label> result;
  for (std::size_t k = 0; k < solids.windings.size(); ++k) {
    graph.set_windings(solids.windings[k]);
    InsideReport report;
    const std::vector<char> solid = label_cells(graph, {}, inside, report).solid;
    if (exact && !report.exact) return {};
    const bool any = std::find(solid.begin(), solid.end(), 1) != solid.end();
    if (!any && !given[k].triangles.empty()) {
      throw_too_small(k, solids.soup.grid);
    }
    result.resize(solid.size());
    for (std::size_t c = 0; c < solid.size(); ++c) {
      const Label label = solid[c] != 0 ? Label::solid : Label::empty;
      result[c] = k == 0 ? label : combine(operation, result[c], label);
    }
  }
  std::vector<char> solid;
  solid.reserve(result.size());
  for (const Label label : result) solid.push_back(label == Label::solid ? 1 : 0);
  return solid;
}

JoinedSolids join_operands(std::span<const TriangleSoup> solids, const BooleanOptions& options,
                           BooleanReport& report) {
  const Grid grid = grid_of(solids, report);
  std::vector<JoinedSolids> operands;
  std::vector<std::uint32_t> source;
  std::uint32_t sources = 0;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    source.push_back(sources);
    sources += static_cast<std::uint32_t>(solids[i].triangles.size());
    JoinedSolids& operand = operands.emplace_back();
    operand.soup = clean_operand(solids[i], i, grid, options, report);
    operand.windings.push_back(windings_of(operand.soup));
  }
  return join_all(operands, source, 0, operands.size());
}

}  // namespace

std::optional<Surface> boolean_by_chambers(std::span<const TriangleSoup> solids,
                                           SetOperation operation, const BooleanOptions& options,
                                           BooleanReport& report) {
  report = {};
  JoinedSolids joined;
  std::optional<Arrangement> arrangement;
  std::vector<char> solid;
  {
    StageMeter meter(report.result.stages, options.repair.progress);
    meter.begin("operands");
    joined = join_operands(solids, options, report);
    if (joined.soup.triangles.empty()) return Surface();
    meter.begin("arrange");
    arrangement = Arrangement::make(joined.soup, report.result.arrange, options.repair.progress);
    if (!arrangement) return std::nullopt;
    meter.begin("inside");
    CellGraph graph = graph_of_chambers(*arrangement, joined.soup, orientation_of(joined));
    solid = combine_regions(graph, solids, joined, operation, true, options);
  }
  if (solid.empty()) return std::nullopt;
  if (std::find(solid.begin(), solid.end(), 1) == solid.end()) return Surface();
  return extract_mesh(joined.soup, *arrangement, solid, options.repair, report.result);
}

Surface boolean_by_cells(std::span<const TriangleSoup> solids, SetOperation operation,
                         const BooleanOptions& options, BooleanReport& report) {
  report = {};
  JoinedSolids joined;
  {
    StageMeter meter(report.result.stages, options.repair.progress);
    meter.begin("operands");
    joined = join_operands(solids, options, report);
  }
  const auto combined = [&](CellGraph& graph) {
    return combine_regions(graph, solids, joined, operation, false, options);
  };
  return extract_mesh(joined.soup, combined, options.repair, report.result);
}

}  // namespace meshrepair::internal
