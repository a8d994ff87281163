// SPDX-License-Identifier: MIT
// What results of the C interface say. The result of a call for which memory ran out is null.
#include <string>

#include <check/check_surface.h>

#include "handles.h"
#include "report/json_report.h"

using namespace meshrepair;

void meshrepair_result_free(meshrepair_result* result) { delete result; }

meshrepair_code meshrepair_result_code(const meshrepair_result* result) {
  if (result == nullptr) return MESHREPAIR_LIMIT;
  return static_cast<meshrepair_code>(result->outcome.code);
}

const char* meshrepair_result_error(const meshrepair_result* result) {
  return result == nullptr ? "out of memory" : result->outcome.error.c_str();
}

const char* meshrepair_result_report(const meshrepair_result* result) {
  return result == nullptr ? "" : result->outcome.report.c_str();
}

size_t meshrepair_result_warning_count(const meshrepair_result* result) {
  return result == nullptr ? 0 : result->outcome.warnings.size();
}

const char* meshrepair_result_warning(const meshrepair_result* result, size_t index) {
  if (index >= meshrepair_result_warning_count(result)) return nullptr;
  return result->outcome.warnings[index].c_str();
}

const meshrepair_mesh* meshrepair_result_mesh(const meshrepair_result* result) {
  return result == nullptr ? nullptr : result->mesh.get();
}

meshrepair_mesh* meshrepair_result_take_mesh(meshrepair_result* result) {
  return result == nullptr ? nullptr : result->mesh.release();
}

const uint32_t* meshrepair_result_sources(const meshrepair_result* result) {
  return result == nullptr || result->sources.empty() ? nullptr : result->sources.data();
}

const uint16_t* meshrepair_result_marks(const meshrepair_result* result) {
  return result == nullptr || result->marks.empty() ? nullptr : result->marks.data();
}

const char* meshrepair_defect_name(size_t bit) {
  if (bit >= kDefects) return nullptr;
  return defect_name(static_cast<Defect>(bit)).data();  // a literal, which ends with a zero
}

const char* meshrepair_version() {
  static const std::string version = program_version();
  return version.c_str();
}
