// SPDX-License-Identifier: MIT
// Warnings: what a user should know though the work goes on, with codes for machines.
//
//   report.warnings.push_back({WarningCode::trailing_bytes, "3 bytes after the last face ignored",
//                              {{"bytes", 3}}});
//
// A code never changes its meaning, and is never used again for another one. Texts may change.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace meshrepair {

// In the order of kWarningKinds in warning.cpp.
enum class WarningCode {
  // The object may be another one than was meant:
  file_cut_off,
  faces_unreadable,
  points_unreadable,
  references_missing,
  extension_unknown,
  unit_unknown,
  start_unclear,
  objects_left_out,
  not_subtracted,
  none_printed,
  project_unreadable,
  float32_step,
  area_lost,
  area_made_up,
  detail_lost,
  below_grid,
  thin_parts_lost,
  slits_filled,
  hollow_filled,
  wall_pokes_out,
  not_hollowed,
  points_noisy,
  points_unused,
  operand_repaired,
  operand_uncertified,
  body_gone,
  // It is the same:
  bytes_ignored,
  content_ignored,
  attributes_unreadable,
  materials_undefined,
  attributes_lost,
  package_parts_lost,
  picture_unreadable,
  parts_all_kept,
  one_block,
  states_not_saved,
  triangles_left,
  thin,
  report_not_written,
};

struct WarningKind {
  std::string_view code;     // "W-AREA-LOST"
  bool changes_object;       // the result may be another object than was meant
  std::string_view meaning;  // a sentence without full stop
};

// What a warning is about: a count, a length in units of the file, or a share of 1.
struct WarningNumber {
  template <class Number>
  WarningNumber(std::string_view its_name, Number number)
      : name(its_name), value(static_cast<double>(number)) {}

  std::string_view name;  // snake_case; a literal
  double value;
};

struct Warning {
  WarningCode code;
  std::string text;  // one sentence for people, without the name of the file
  std::vector<WarningNumber> numbers = {};
};

[[nodiscard]] const WarningKind& kind_of(WarningCode code);

// All, in the order of WarningCode.
[[nodiscard]] std::span<const WarningKind> warning_kinds();

}  // namespace meshrepair
