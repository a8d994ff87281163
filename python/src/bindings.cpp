// SPDX-License-Identifier: MIT
#include "bindings.h"

#include <memory>
#include <pybind11/stl.h>
#include <utility>

#include <base/error.h>

#include "arrays.h"
#include "attribute_arrays.h"

namespace meshrepair {
namespace {

namespace py = pybind11;

void check_fits(const Attributes& attributes, const TriangleSoup& soup) {
  const std::size_t triangles = soup.triangles.size();
  bool fits = true;
  for (const CornerAttribute& corner : attributes.corners) {
    fits = fits && corner.of_corner.size() == 3 * triangles;
  }
  for (const TriangleLabels* labels :
       {&attributes.materials, &attributes.groups, &attributes.objects, &attributes.smoothing}) {
    fits = fits && (labels->empty() || labels->of_triangle.size() == triangles);
  }
  if (!fits) throw UsageError("attributes: are of a mesh with another number of faces");
}

}  // namespace

Attributes given_attributes(const py::object& given, const py::object& known,
                            const TriangleSoup& soup) {
  if (given.is_none()) return {};
  if (py::isinstance<KeptAttributes>(given)) {
    Attributes attributes = given.cast<const KeptAttributes&>().attributes;
    check_fits(attributes, soup);
    return attributes;
  }
  if (!py::isinstance<py::dict>(given)) throw UsageError("attributes: are no dict of arrays");
  const Attributes* more =
      known.is_none() ? nullptr : &known.cast<const KeptAttributes&>().attributes;
  try {
    return attributes_of(given.cast<py::dict>(), soup, more);
  } catch (py::error_already_set& error) {  // what is in the dict cannot be looked at
    if (!error.matches(PyExc_Exception)) throw;
    const std::string said = error.what();
    throw UsageError("attributes: cannot be read: " + said.substr(0, said.find('\n')));
  }
}

py::str text_of(const std::string& bytes) {
  return py::bytes(bytes).attr("decode")("utf-8", "replace");
}

py::dict dict_of(const Outcome& outcome) {
  py::list warnings;
  for (const std::string& warning : outcome.warnings) warnings.append(text_of(warning));
  py::dict result;
  result["code"] = static_cast<int>(outcome.code);
  result["error"] = outcome.error.empty() ? py::object(py::none()) : text_of(outcome.error);
  result["report"] = outcome.report;
  result["warnings"] = warnings;
  return result;
}

void add_mesh(py::dict& result, TriangleSoup soup, Attributes attributes, bool as_float32) {
  result["attributes"] = dict_of(attributes, soup);
  const auto kept = std::make_shared<TriangleSoup>(std::move(soup));
  result["vertices"] = vertices_of(kept, as_float32);
  result["faces"] = faces_of(kept);
  result["kept"] = py::cast(KeptAttributes{std::move(attributes)});
}

}  // namespace meshrepair
