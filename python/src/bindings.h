// SPDX-License-Identifier: MIT
// What the extension module offers. Each function returns a dict: "code", "error", "report" and
// "warnings" of the outcome, and where it went well the arrays that are named beside it. The Python
// files of the package check arguments before, and raise exceptions after.
#pragma once

#include <pybind11/pybind11.h>
#include <string>

#include <extract/surface.h>
#include <mesh/attributes.h>
#include <mesh/soup.h>

#include "calls/session.h"

namespace meshrepair {

// repair(), repair_points(), repair_file(), boolean(), bodies().
void bind_repairs(pybind11::module_& module);
// check(), distance().
void bind_measures(pybind11::module_& module);
// read(), write().
void bind_files(pybind11::module_& module);

// Attributes as Python holds them between two calls, with all that arrays do not say.
struct KeptAttributes {
  Attributes attributes;
};

// `given` is None, KeptAttributes of a mesh with as many faces, or a dict of arrays; then `known`
// may be KeptAttributes that say more of the same materials. Throws UsageError.
[[nodiscard]] Attributes given_attributes(const pybind11::object& given,
                                          const pybind11::object& known, const TriangleSoup& soup);

// For people; names of files need be no UTF-8.
[[nodiscard]] pybind11::str text_of(const std::string& bytes);

[[nodiscard]] pybind11::dict dict_of(const Outcome& outcome);
// Adds "vertices", "faces", "attributes" (a dict) and "kept".
void add_mesh(pybind11::dict& result, TriangleSoup soup, Attributes attributes, bool as_float32);

}  // namespace meshrepair
