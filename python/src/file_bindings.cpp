// SPDX-License-Identifier: MIT
// Files of meshes and points, as they are: nothing is repaired.
#include <optional>
#include <pybind11/stl.h>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "calls/file_calls.h"
#include "without_lock.h"

namespace meshrepair {
namespace {

namespace py = pybind11;

void add_points(py::dict& result, PointCloud cloud) {
  const auto points = std::make_shared<TriangleSoup>();
  points->points = std::move(cloud.points);
  result["points"] = vertices_of(points, false);
  result["normals"] = py::none();
  if (cloud.normals.empty()) return;
  const auto normals = std::make_shared<TriangleSoup>();
  normals->points = std::move(cloud.normals);
  result["normals"] = vertices_of(normals, false);
}

// Either a mesh, and "unit", or "points" and "normals".
py::dict read_path(const std::string& path, bool attributes, const Keywords& keywords,
                   const py::object& told) {
  ReadOutcome outcome = read_call(path, attributes, keywords, without_lock(told));
  py::dict result = dict_of(outcome);
  if (outcome.code != ExitCode::done) return result;
  if (outcome.input.cloud) {
    add_points(result, std::move(*outcome.input.cloud));
    return result;
  }
  result["unit"] = outcome.unit ? py::object(py::str(std::string(unit_name(*outcome.unit))))
                                : py::object(py::none());
  add_mesh(result, std::move(outcome.input.soup), std::move(outcome.input.attributes), false);
  return result;
}

py::dict write_path(const std::string& path, const py::array& vertices, const py::array& faces,
                    const py::object& attributes, const py::object& known,
                    const std::optional<std::string>& unit, const py::object& sources,
                    const Keywords& keywords, const py::object& told) {
  const TriangleSoup soup = soup_of(vertices, faces, true);
  const Attributes carried = given_attributes(attributes, known, soup);
  GivenForFile given;
  given.soup = &soup;
  given.attributes = &carried;
  given.unit = unit;
  if (!sources.is_none()) given.sources = sources.cast<std::vector<std::uint32_t>>();
  return dict_of(write_call(path, given, keywords, without_lock(told)));
}

}  // namespace

void bind_files(py::module_& module) {
  module.def("read", &read_path);
  module.def("write", &write_path);
}

}  // namespace meshrepair
