// SPDX-License-Identifier: MIT
// All that is known of a run: what was read, what was found, and what was written.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <bsp/tree.h>
#include <check/thin_places.h>
#include <hollow/hollow_report.h>
#include <hollow/offset.h>
#include <mesh/point_io.h>
#include <mesh/soup_io.h>
#include <repair/fidelity.h>
#include <repair/repair.h>
#include <repair/repair_points.h>

#include "options/purposes.h"
#include "report/json.h"

namespace meshrepair {

// What a .bsp file held.
struct TreeFacts {
  std::size_t triangles = 0;
  std::size_t nodes = 0;
  std::size_t leaves = 0;
  std::size_t solid_leaves = 0;
  bool labelled = false;
};

[[nodiscard]] TreeFacts facts_of(const Tree& tree);

// All that is known of a run, filled as far as the work came.
struct Findings {
  Findings(std::string input_path, std::string output_path)
      : input(std::move(input_path)), output(std::move(output_path)) {}

  // For people: "-" by what it stands for.
  [[nodiscard]] std::string input_name() const;
  [[nodiscard]] std::string output_name() const;
  [[nodiscard]] std::string written_name() const;  // also where it is until it is moved there

  std::string input;
  std::string output;
  std::string staging;  // where the output is written first; empty: where it belongs
  std::optional<ReadReport> mesh_read;
  std::optional<LengthUnit> unit;    // of the output, as far as it is known
  std::optional<Vec3d> origin;       // added to coordinates of the output: those that were meant
  bool is_origin_in_places = false;  // of meshes in a scene, and not to be added
  std::optional<PointReadReport> points_read;
  std::optional<PointSoupReport> point_soup;
  std::size_t points_in_result = 0;  // of those left in point_soup
  std::size_t joined_columns = 0;    // points left out before that, as RepairPointsReport says
  std::optional<ScanBaseReport> scan_base;
  std::vector<PointTry> tries;     // of repair_points()
  std::size_t dropped_solids = 0;  // too small for the points to tell
  bool soup_written = false;       // the output is a soup, no solid
  std::size_t soup_triangles = 0;  // of it
  std::optional<TreeFacts> tree_read;
  std::optional<TreeFacts> tree_written;
  RepairReport repair;
  HollowReport hollow;
  OffsetReport offset;
  std::optional<ThinReport> thin;  // of the output, if that was looked for
  bool has_walls = false;          // of sheets, in some mesh of a scene
  bool wants_fidelity = false;     // though there is no report
  std::optional<Fidelity> fidelity;
  std::size_t output_points = 0;
  std::string missing_guarantees;    // of that mesh, for people; empty: it holds all
  bool withheld = false;             // not written because of these, or of what is not met
  bool told = false;                 // what is to be warned of
  Json required;                     // what became of each requirement; null: there are none
  std::vector<std::string> not_met;  // requirements, a sentence each
  Purpose purpose;
  std::string explained;   // the file that says what became of the triangles; may be empty
  std::string summary;     // instead of that of summary_of(), if it is not empty
  std::string shown;       // a picture, as terminals have it, for below the summary; may be empty
  bool shows_bar = false;  // a bar of what changed, instead
};

}  // namespace meshrepair
