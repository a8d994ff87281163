// SPDX-License-Identifier: MIT
// What is wrong with a mesh, and how far two are apart.
#include <pybind11/stl.h>
#include <utility>

#include "arrays.h"
#include "bindings.h"
#include "calls/measure_calls.h"
#include "without_lock.h"

namespace meshrepair {
namespace {

namespace py = pybind11;

py::array marks_of(std::vector<std::uint16_t> marks) {
  const auto kept = std::make_shared<std::vector<std::uint16_t>>(std::move(marks));
  return view_of(kept, kept->data(), {static_cast<py::ssize_t>(kept->size())});
}

// Also "marks": of each face a bit for each defect that it has, in the order of "defects".
py::dict check_mesh(const py::array& vertices, const py::array& faces, const Keywords& keywords,
                    const py::object& told) {
  CheckOutcome outcome = check_call(soup_of(vertices, faces, true), keywords, without_lock(told));
  py::dict result = dict_of(outcome);
  std::vector<std::string> defects;
  for (std::size_t d = 0; d < kDefects; ++d) {
    defects.emplace_back(defect_name(static_cast<Defect>(d)));
  }
  result["defects"] = defects;
  result["marks"] = marks_of(std::move(outcome.check.marks));
  return result;
}

py::dict distance_of(const py::array& vertices, const py::array& faces,
                     const py::array& other_vertices, const py::array& other_faces,
                     const Keywords& keywords, const py::object& told) {
  return dict_of(distance_call(soup_of(vertices, faces, true),
                               soup_of(other_vertices, other_faces, true), keywords,
                               without_lock(told)));
}

}  // namespace

void bind_measures(py::module_& module) {
  module.def("check", &check_mesh);
  module.def("distance", &distance_of);
}

}  // namespace meshrepair
