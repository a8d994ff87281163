// SPDX-License-Identifier: MIT
// The extension module meshrepair._core: the libraries, for the Python files of the package.
#include <exception>
#include <new>
#include <pybind11/pybind11.h>

#include <base/error.h>

#include "arrays.h"
#include "bindings.h"
#include "without_lock.h"

namespace meshrepair {
namespace {

namespace py = pybind11;

// The exception of the package that has the same exit code.
void raise_as_python(const std::exception_ptr& error) {
  const Failure failure = describe_failure(error);
  const py::object raised =
      py::module_::import("meshrepair.errors")
          .attr("error_of")(static_cast<int>(failure.code), text_of(failure.message));
  PyErr_SetObject(py::type::handle_of(raised).ptr(), raised.ptr());
}

// What is thrown before any work begins.
void translate(std::exception_ptr error) {
  try {
    if (error) std::rethrow_exception(error);
  } catch (const Error&) {
    raise_as_python(error);
  } catch (const std::bad_alloc&) {
    raise_as_python(error);
  }
}

}  // namespace
}  // namespace meshrepair

PYBIND11_MODULE(_core, module) {
  using namespace meshrepair;
  namespace py = pybind11;
  stop_work_at_exit();
  py::register_exception_translator(&translate);
  const py::class_<KeptAttributes> kept(module, "KeptAttributes");
  module.attr("version") = program_version();
  module.def("triangulated", &triangulated);
  bind_repairs(module);
  bind_measures(module);
  bind_files(module);
}
