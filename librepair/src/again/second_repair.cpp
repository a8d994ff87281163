// SPDX-License-Identifier: MIT
#include "second_repair.h"

#include <iterator>
#include <limits>
#include <utility>

#include <mesh/append_soup.h>
#include <mesh/weld_points.h>

namespace meshrepair::internal {

void SecondSoup::append(const TriangleSoup& added, const std::vector<std::uint32_t>& sources) {
  append_soup(soup, added);
  source.insert(source.end(), sources.begin(), sources.end());
  input_point.resize(soup.points.size(), 0);
}

RepairOptions options_for_second(const SecondSoup& second, const RepairOptions& options) {
  RepairOptions again = options;
  again.thicken = {};
  again.seal = {};
  again.keep = {};
  again.explain = false;
  again.sew.mode = SewMode::none;
  again.holes.mode = HoleMode::none;
  again.inside.rule = InsideRule::winding;
  again.opacity.clear();
  again.examine = nullptr;
  again.all_cells = false;
  if (options.reach.empty()) return again;
  again.reach.clear();
  for (const std::uint32_t source : second.source) {
    again.reach.push_back(source == Surface::kNoSource ? std::numeric_limits<double>::infinity()
                                                       : options.reach[source]);
  }
  return again;
}

void refer_to_first(const SecondSoup& second, Surface& surface) {
  for (std::uint32_t& source : surface.source) {
    if (source != Surface::kNoSource) source = second.source[source];
  }
  // A point that was added counts for nothing, also where one that was given has its place.
  const std::vector<std::uint32_t> place = first_in_place(second.soup.points, surface.mesh.points);
  for (std::size_t p = 0; p < place.size(); ++p) {
    const bool is_given = place[p] < second.input_point.size() && second.input_point[place[p]] != 0;
    if (!is_given) surface.input_point[p] = 0;
  }
}

void append_report(RepairReport second, RepairReport& report) {
  report.kept_valid = false;
  report.spared_cells = false;
  report.predicates = second.predicates;
  report.epsilon = second.epsilon;
  report.extract = second.extract;
  report.thin_cells = second.thin_cells;
  report.precision = second.precision;
  report.slits_area = second.slits_area;
  report.fins_area = second.fins_area;
  report.crumbs += second.crumbs;
  report.simplify = second.simplify;
  report.certify = second.certify;
  report.stages.insert(report.stages.end(), std::make_move_iterator(second.stages.begin()),
                       std::make_move_iterator(second.stages.end()));
}

}  // namespace meshrepair::internal
