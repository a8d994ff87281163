// SPDX-License-Identifier: MIT
#include "resume/saved_states.h"

#include <functional>
#include <map>
#include <ostream>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <base/state_store.h>
#include <repair/repair.h>

#include "degenerate_soups.h"
#include "shapes.h"

namespace meshrepair {
namespace {

using internal::BrokenState;
using internal::SavedStates;
using internal::StateReader;
using internal::StateWriter;

template <class... Values>
std::string bytes_of(const Values&... values) {
  std::ostringstream out;
  StateWriter writer(out);
  (writer(values), ...);
  return out.str();
}

class MemoryStore : public StateStore {
 public:
  bool has(const std::string& name) const override { return states.count(name) > 0; }
  bool load(const std::string& name,
            const std::function<void(std::istream&, std::uint64_t)>& read) override {
    if (!has(name)) return false;
    std::istringstream in(states[name]);
    read(in, states[name].size());
    loaded.insert(kind_of(name));
    return true;
  }
  void save(const std::string& name, const std::function<void(std::ostream&)>& write) override {
    std::ostringstream out;
    write(out);
    states[name] = all[name] = out.str();
  }
  void drop(const std::string& name) override { states.erase(name); }

  static std::string kind_of(const std::string& name) { return name.substr(0, name.find('-')); }
  // Those that were ever saved, of these kinds.
  [[nodiscard]] std::map<std::string, std::string> of_kinds(const std::set<std::string>& kinds) {
    std::map<std::string, std::string> found;
    for (const auto& [name, bytes] : all) {
      if (kinds.count(kind_of(name)) > 0) found.emplace(name, bytes);
    }
    return found;
  }

  std::map<std::string, std::string> states, all;
  std::set<std::string> loaded;  // kinds
};

RepairOptions options_with(StateStore* store) {
  RepairOptions options;
  options.states = store;
  return options;
}

// The surface, and of each part of the report what tells that it is there.
struct Outcome {
  std::string surface, facts;
  bool operator==(const Outcome&) const = default;
};

void PrintTo(const Outcome& outcome, std::ostream* out) { *out << outcome.facts; }

Outcome outcome_of(const TriangleSoup& soup, const RepairOptions& options) {
  RepairReport report;
  try {
    const Surface surface = repair(soup, options, report);
    std::ostringstream facts;
    facts << report.clean.grid_unit << ' ' << report.input.open_edges << ' ' << report.input_area
          << ' ' << report.holes.triangles << ' ' << report.arrange.facets << ' ' << report.cells
          << ' ' << report.orient.turned_triangles << ' ' << report.inside.reason << ' '
          << report.inside.cavity_walls << ' ' << report.parts.inside_triangles << ' '
          << report.parts.places.size() << ' ' << report.extract.regions << ' '
          << report.simplify.removed_points << ' ' << report.certify.done << ' '
          << report.certify.faults() << ' ' << report.triangles.untouched << ' '
          << report.output.parts << ' ' << report.output_volume << ' ' << report.closing_area;
    return {bytes_of(surface), facts.str()};
  } catch (const NoSolidError& error) {
    return {{}, error.what()};
  }
}

// Spheres that cross, with holes and flips; a soup that needs cells.
std::vector<TriangleSoup> soups() {
  const TriangleSoup spheres = testing::two_overlapping_spheres(400);
  std::vector<TriangleSoup> all = {
      testing::with_some_flipped(testing::without_some(spheres, 0.02, 1), 0.1, 2),
      testing::random_grid_boxes(12, 5, 3), testing::noisy_sphere(100, 0.2, 4)};
  for (const testing::SoupFamily& family : testing::degenerate_families()) {
    all.push_back(family.make(5));
  }
  return all;
}

TEST(SavedStates, RunsGoOnFromEachState) {
  std::set<std::string> loaded;
  for (const TriangleSoup& soup : soups()) {
    const Outcome whole = outcome_of(soup, options_with(nullptr));
    MemoryStore first;
    ASSERT_EQ(outcome_of(soup, options_with(&first)), whole);
    for (const std::set<std::string>& kinds : std::vector<std::set<std::string>>{
             {"prepared"}, {"prepared", "chambers"}, {"chambers"}, {"repaired"}}) {
      MemoryStore second;
      second.states = first.of_kinds(kinds);
      ASSERT_EQ(outcome_of(soup, options_with(&second)), whole);
      loaded.insert(second.loaded.begin(), second.loaded.end());
    }
  }
  EXPECT_EQ(loaded, (std::set<std::string>{"prepared", "chambers", "repaired"}));
}

TEST(SavedStates, AtTheEndOnlyTheResultIsKept) {
  MemoryStore store;
  (void)outcome_of(soups()[0], options_with(&store));
  ASSERT_EQ(store.states.size(), 1u);
  EXPECT_EQ(MemoryStore::kind_of(store.states.begin()->first), "repaired");
}

TEST(SavedStates, OtherSoupsAndOtherReachHaveOthers) {
  TriangleSoup soup = soups()[0];
  MemoryStore store;
  RepairOptions options = options_with(&store);
  const auto names_more = [&] {
    const std::size_t before = store.all.size();
    (void)outcome_of(soup, options);
    return store.all.size() > before;
  };
  EXPECT_TRUE(names_more());
  EXPECT_FALSE(names_more());
  soup.points[7].x() += 1e-12;
  EXPECT_TRUE(names_more());
  std::swap(soup.triangles[3], soup.triangles[4]);
  EXPECT_TRUE(names_more());
  options.reach.assign(soup.triangles.size(), 1.0);
  EXPECT_TRUE(names_more());
}

TEST(SavedStates, WhatIsCutOffOrTooLongIsNotUsed) {
  const TriangleSoup soup = soups()[0];
  const Outcome whole = outcome_of(soup, options_with(nullptr));
  MemoryStore first;
  (void)outcome_of(soup, options_with(&first));
  for (const auto& [name, bytes] : first.all) {
    for (const std::string& damaged :
         {std::string(), bytes.substr(0, 5), bytes.substr(0, bytes.size() / 2),
          bytes.substr(0, bytes.size() - 1), bytes + "x"}) {
      MemoryStore second;
      second.states = {{name, damaged}};
      ASSERT_EQ(outcome_of(soup, options_with(&second)), whole) << name << ' ' << damaged.size();
    }
  }
}

TEST(StateBytes, ListsAreNoLongerThanWhatIsThere) {
  std::string bytes = bytes_of(std::uint64_t{1} << 60) + std::string(100, 'x');
  std::istringstream in(bytes);
  StateReader reader(in, bytes.size());
  std::vector<double> list;
  EXPECT_THROW(reader(list), BrokenState);
  EXPECT_TRUE(list.empty());
}

TEST(StateBytes, PlanesComeBackWithTheirIds) {
  PlaneTable planes;
  for (int i = 0; i < 10'000; ++i) {
    const Int128 offset = (Int128{i} << 60) * (i % 2 == 0 ? 1 : -1) - i;
    planes.append(make_plane({i, 7 - i, 1 + i % 3}, offset));
  }
  const std::string bytes = bytes_of(planes);
  std::istringstream in(bytes);
  StateReader reader(in, bytes.size());
  PlaneTable again;
  reader(again);
  EXPECT_TRUE(reader.at_end());
  ASSERT_EQ(again.size(), planes.size());
  for (PlaneId p(0u); p.index() < planes.size(); ++p.value) {
    ASSERT_TRUE(same_coefficients(again[p], planes[p]));
    ASSERT_EQ(again[p].unit, planes[p].unit);
    ASSERT_EQ(again[p].unit_offset, planes[p].unit_offset);
  }
}

}  // namespace
}  // namespace meshrepair
