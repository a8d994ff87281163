// SPDX-License-Identifier: MIT
// What a report says of a result that another one takes the place of.
#pragma once

#include <utility>

#include <repair/repair_report.h>

namespace meshrepair::internal {

// `told`: of the operation that made the new one.
inline void replace_result(RepairReport& report, const RepairReport& told) {
  report.certify = told.certify;
  report.output = told.output;
  report.output_volume = told.output_volume;
  report.output_area = told.output_area;
  report.spared_cells |= std::exchange(report.kept_valid, false);
  report.same_triangles = false;
}

}  // namespace meshrepair::internal
