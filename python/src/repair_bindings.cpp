// SPDX-License-Identifier: MIT
// Repairs: of a mesh or points in memory, of a file, of several meshes as one, and of several
// bodies with common faces.
#include <array>
#include <cstdint>
#include <memory>
#include <pybind11/stl.h>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <base/error.h>
#include <mesh/point_cloud.h>

#include "arrays.h"
#include "bindings.h"
#include "calls/repair_calls.h"
#include "without_lock.h"

namespace meshrepair {
namespace {

namespace py = pybind11;

bool is_float32(const py::array& array) {
  return array.dtype().kind() == 'f' && array.dtype().itemsize() == 4;
}

py::dict result_of(RepairOutcome outcome) {
  py::dict answer = dict_of(outcome);
  if (!outcome.has_mesh()) return answer;
  answer["source"] = indices_of(std::move(outcome.mesh.surface.source));
  add_mesh(answer, std::move(outcome.mesh.surface.mesh), std::move(outcome.mesh.attributes),
           outcome.as_float32);
  return answer;
}

py::dict repair_mesh(const py::array& vertices, const py::array& faces,
                     const py::object& attributes, const py::object& known, bool may_be_not_finite,
                     const Keywords& keywords, const py::object& told, bool distance) {
  AnySoup input;
  input.soup = soup_of(vertices, faces, may_be_not_finite);
  input.attributes = given_attributes(attributes, known, input.soup);
  return result_of(
      repair_call(std::move(input), is_float32(vertices), distance, keywords, without_lock(told)));
}

py::dict repair_cloud(const py::array& points, const py::object& normals, bool may_be_not_finite,
                      const Keywords& keywords, const py::object& told, bool distance) {
  AnySoup input;
  PointCloud& cloud = input.cloud.emplace();
  cloud.points = points_of(points, "points", may_be_not_finite);
  if (!normals.is_none()) {
    cloud.normals = points_of(normals.cast<py::array>(), "normals", true);
    if (cloud.normals.size() != cloud.points.size()) {
      throw UsageError("normals: are " + std::to_string(cloud.normals.size()) + ", but there are " +
                       std::to_string(cloud.points.size()) + " points");
    }
  }
  return result_of(
      repair_call(std::move(input), is_float32(points), distance, keywords, without_lock(told)));
}

py::dict repair_path(const std::string& input, const std::string& output, const Keywords& keywords,
                     const py::object& told, bool distance) {
  return dict_of(repair_file_call(input, output, distance, keywords, without_lock(told)));
}

// Of a mesh in boolean().
using GivenMesh = std::tuple<py::array, py::array, py::object, py::object>;

py::dict combine_meshes(const std::vector<GivenMesh>& meshes, bool may_be_not_finite,
                        const Keywords& keywords, const py::object& told) {
  std::vector<AnySoup> operands;
  bool all_float32 = true;
  for (const auto& [vertices, faces, attributes, known] : meshes) {
    AnySoup& operand = operands.emplace_back();
    try {
      operand.soup = soup_of(vertices, faces, may_be_not_finite);
      operand.attributes = given_attributes(attributes, known, operand.soup);
    } catch (const UsageError& error) {
      throw UsageError(operand_name(operands.size() - 1) + ": " + error.what());
    }
    all_float32 = all_float32 && is_float32(vertices);
  }
  return result_of(boolean_call(std::move(operands), all_float32, keywords, without_lock(told)));
}

// Of each triangle what is in front and behind: (m, 2) int32.
py::array sides_of(std::vector<std::array<std::uint32_t, 2>> sides) {
  using Sides = std::vector<std::array<std::uint32_t, 2>>;
  const auto owner = std::make_shared<Sides>(std::move(sides));
  return view_of(owner, reinterpret_cast<const std::int32_t*>(owner->data()),
                 {static_cast<py::ssize_t>(owner->size()), 2});
}

py::dict divide_bodies(const std::vector<std::pair<py::array, py::array>>& meshes,
                       bool may_be_not_finite, const Keywords& keywords, const py::object& told) {
  std::vector<TriangleSoup> bodies;
  for (const auto& [vertices, faces] : meshes) {
    try {
      bodies.push_back(soup_of(vertices, faces, may_be_not_finite));
    } catch (const UsageError& error) {
      throw UsageError(operand_name(bodies.size()) + ": " + error.what());
    }
  }
  BodiesOutcome outcome = bodies_call(std::move(bodies), keywords, without_lock(told));
  py::dict answer = dict_of(outcome);
  if (outcome.code != ExitCode::done && outcome.code != ExitCode::not_certified) return answer;
  answer["source"] = indices_of(std::move(outcome.bodies.source));
  answer["regions"] = sides_of(std::move(outcome.bodies.regions_of));
  add_mesh(answer, std::move(outcome.bodies.mesh), {}, false);
  return answer;
}

}  // namespace

void bind_repairs(py::module_& module) {
  module.def("repair", &repair_mesh);
  module.def("repair_points", &repair_cloud);
  module.def("repair_file", &repair_path);
  module.def("boolean", &combine_meshes);
  module.def("bodies", &divide_bodies);
}

}  // namespace meshrepair
