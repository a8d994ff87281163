// SPDX-License-Identifier: MIT
// Handles of the C interface that free themselves, and calls as tests write them.
#pragma once

#include <fstream>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <string>
#include <utility>

#include <meshrepair.h>

#include "shapes.h"

namespace meshrepair::testing {

struct FreeHandle {
  void operator()(meshrepair_mesh* it) const { meshrepair_mesh_free(it); }
  void operator()(meshrepair_options* it) const { meshrepair_options_free(it); }
  void operator()(meshrepair_result* it) const { meshrepair_result_free(it); }
};
using Mesh = std::unique_ptr<meshrepair_mesh, FreeHandle>;
using Options = std::unique_ptr<meshrepair_options, FreeHandle>;
using Result = std::unique_ptr<meshrepair_result, FreeHandle>;

inline Mesh mesh_of(const TriangleSoup& soup) {
  return Mesh(meshrepair_mesh_new(
      soup.points.empty() ? nullptr : soup.points[0].data(), soup.points.size(),
      soup.triangles.empty() ? nullptr : soup.triangles[0].data(), soup.triangles.size()));
}

// A null value is that of a flag.
using Setting = std::pair<const char*, const char*>;
inline Options options_of(std::initializer_list<Setting> settings) {
  Options options(meshrepair_options_new());
  for (const auto& [name, value] : settings) {
    (void)meshrepair_options_set(options.get(), name, value);
  }
  return options;
}

inline meshrepair_code code_of(const Result& result) {
  return meshrepair_result_code(result.get());
}
inline std::string error_of(const Result& result) { return meshrepair_result_error(result.get()); }
inline const meshrepair_mesh* mesh_in(const Result& result) {
  return meshrepair_result_mesh(result.get());
}

inline std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace meshrepair::testing
