#include "without_lock.h"

#include "calls/worker.h"

namespace meshrepair {
namespace {

namespace py = pybind11;

void tell(CallProgress& progress, const py::object& told) {
  if (told.is_none()) return;
  for (const CallProgress::Event& event : progress.take_events()) {
    told(py::str(event.stage), event.share);
  }
}

Outcome run_without_lock(const Session& session, const Session::Body& body,
                         const py::object& told) {
  CallProgress progress(session.limits());
  Outcome outcome;
  const auto look = [&] {
    const py::gil_scoped_acquire locked;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      tell(progress, told);
    } catch (...) {
      progress.ask_to_stop();
      throw;
    }
  };
  {
    const py::gil_scoped_release unlocked;
    run_watched([&] { outcome = session.run(progress, body); }, look);
  }
  tell(progress, told);
  return outcome;
}

}  // namespace

Runner without_lock(const py::object& told) {
  return [told](const Session& session, const Session::Body& body) {
    return run_without_lock(session, body, told);
  };
}

}  // namespace meshrepair
