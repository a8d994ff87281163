// SPDX-License-Identifier: MIT
// How well does each inside rule stand what happens to meshes on their way? Takes closed meshes,
// corrupts copies of them in known ways, and prints the volume by each rule relative to that of the
// mesh itself by `auto`. At the end: in how many cases `auto` comes within a hundredth, and the
// others.
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <base/error.h>
#include <extract/build_cells.h>
#include <extract/cover_facets.h>
#include <mesh/soup_io.h>
#include <mesh/topology.h>
#include <repair/cell_graph.h>
#include <repair/inside_rule.h>
#include <repair/orient_parts.h>
#include <repair/repair.h>

#include "shapes.h"

using namespace meshrepair;
using namespace meshrepair::testing;

namespace {

constexpr std::uint64_t kSeed = 1;
constexpr double kClose = 0.01;
constexpr std::array<InsideRule, 4> kRules = {InsideRule::parity, InsideRule::solidity,
                                              InsideRule::winding, InsideRule::automatic};

struct Corruption {
  std::string name;
  std::function<TriangleSoup(const TriangleSoup&)> apply;
};

struct Volumes {
  std::array<double, kRules.size()> by_rule{};
  InsideReport automatic;
};

TriangleSoup with_some_doubled(TriangleSoup soup, double share, bool opposite) {
  Random random(kSeed);
  const std::size_t count = soup.triangles.size();
  for (std::size_t t = 0; t < count; ++t) {
    if (share < 1 && !random.chance(share)) continue;
    auto copy = soup.triangles[t];
    if (opposite) std::swap(copy[1], copy[2]);
    soup.triangles.push_back(copy);
  }
  return soup;
}

// Parts are connected through edges, on points that are joined where they are equal.
TriangleSoup with_some_parts_inverted(TriangleSoup soup) {
  CleanReport report;
  const CleanSoup clean = clean_soup(soup, report);
  TopologyPlaces places;
  const Topology topology = examine_topology(index_triangles(clean), clean.points.size(), &places);
  Random random(kSeed);
  std::vector<char> inverted;
  for (std::size_t p = 0; p < topology.parts; ++p) inverted.push_back(random.chance(0.5) ? 1 : 0);
  for (TriangleId t(0u); t < clean.triangles.end_id(); ++t.value) {
    if (inverted[places.parts[t.index()]] == 0) continue;
    auto& corners = soup.triangles[clean.triangles[t].source];
    std::swap(corners[1], corners[2]);
  }
  return soup;
}

std::vector<Corruption> corruptions() {
  std::vector<Corruption> list;
  for (const int percent : {0, 1, 5, 20, 50}) {
    list.push_back({std::to_string(percent) + " % flipped", [=](const TriangleSoup& s) {
                      return with_some_flipped(s, percent / 100.0, kSeed);
                    }});
  }
  for (const int percent : {1, 5, 10}) {
    list.push_back({std::to_string(percent) + " % removed", [=](const TriangleSoup& s) {
                      return without_some(s, percent / 100.0, kSeed + 1);
                    }});
  }
  for (const int flipped : {1, 5, 20, 50}) {
    for (const int removed : {1, 5, 10}) {
      list.push_back(
          {std::to_string(flipped) + " % flipped, " + std::to_string(removed) + " % removed",
           [=](const TriangleSoup& s) {
             return without_some(with_some_flipped(s, flipped / 100.0, kSeed), removed / 100.0,
                                 kSeed + 1);
           }});
    }
  }
  list.push_back({"all flipped", [](const TriangleSoup& s) { return flipped(s); }});
  list.push_back(
      {"5 % doubled", [](const TriangleSoup& s) { return with_some_doubled(s, 0.05, false); }});
  list.push_back({"5 % doubled, opposite",
                  [](const TriangleSoup& s) { return with_some_doubled(s, 0.05, true); }});
  list.push_back({"parts inverted", with_some_parts_inverted});
  list.push_back({"all doubled, opposite",
                  [](const TriangleSoup& s) { return with_some_doubled(s, 1, true); }});
  return list;
}

double volume_of(const std::vector<double>& cells, const CellLabels& labels) {
  double sum = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) sum += labels.solid[c] != 0 ? cells[c] : 0;
  return sum;
}

// Volumes in grid units of the soup itself times `unit` cubed. One tree and one complex for all
// rules.
Volumes volumes_of(const TriangleSoup& soup) {
  RepairReport repair_report;
  const Tree tree = make_tree(soup, {}, repair_report);  // holes are patched
  ClipReport clip;
  CellComplex complex = build_cells(tree, {}, clip);
  CoverReport cover_report;
  std::vector<CoverLayer> layers;
  const auto cover = cover_facets(complex, windings_of(tree.input), cover_report, nullptr, &layers);
  CellGraph graph(complex, cover, nullptr, layers);
  const double unit = tree.input.grid.unit;
  std::vector<double> cells;
  for (CellId c(0u); c < complex.cells.end_id(); ++c.value) {
    cells.push_back(cell_volume(complex, c) * unit * unit * unit);
  }
  OrientReport orient_report;
  const Orientation orientation = orient_parts(tree.input, orient_report);
  Volumes volumes;
  for (std::size_t r = 0; r < kRules.size(); ++r) {
    if (kRules[r] == InsideRule::automatic) graph.set_windings(orientation.winding);
    InsideOptions options;
    options.rule = kRules[r];
    InsideReport report;
    volumes.by_rule[r] = volume_of(cells, label_cells(graph, orientation, options, report));
    volumes.automatic = report;
  }
  return volumes;
}

struct Tally {
  std::size_t cases = 0, close = 0;
  std::vector<std::string> others;
};

void measure_file(const std::string& path, Tally& tally) {
  const std::string name = std::filesystem::path(path).filename().string();
  const TriangleSoup soup = read_soup(path).soup;
  const double truth = volumes_of(soup).by_rule.back();
  for (const Corruption& corruption : corruptions()) {
    const Volumes volumes = volumes_of(corruption.apply(soup));
    std::printf("| %s | %s |", name.c_str(), corruption.name.c_str());
    for (const double v : volumes.by_rule) std::printf(" %.4f |", v / truth);
    const InsideReport& automatic = volumes.automatic;
    std::printf(" %.3f | %.3f | %s: %s |\n", automatic.winding_distance,
                automatic.winding_contradiction, std::string(rule_name(automatic.used)).c_str(),
                automatic.reason.c_str());
    std::fflush(stdout);
    ++tally.cases;
    const double share = volumes.by_rule.back() / truth;
    if (std::abs(share - 1) <= kClose) {
      ++tally.close;
    } else {
      char text[32];
      std::snprintf(text, sizeof text, "%.4f", share);
      tally.others.push_back(name + ", " + corruption.name + ": " + text + " by " +
                             std::string(rule_name(volumes.automatic.used)) + ", " +
                             volumes.automatic.reason);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::printf(
      "| mesh | copy | parity | solidity | winding | auto | distance | contradiction | why |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  Tally tally;
  for (int i = 1; i < argc; ++i) {
    try {
      measure_file(argv[i], tally);
    } catch (const Error& e) {
      std::printf("%s: %s\n", argv[i], e.what());
    }
  }
  std::printf("\n`auto` within 1 %%: %zu of %zu cases\n\n", tally.close, tally.cases);
  for (const std::string& other : tally.others) std::printf("- %s\n", other.c_str());
  return 0;
}
