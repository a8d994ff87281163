// How a call from Python works without Python's lock, and can be interrupted.
#pragma once

#include <pybind11/pybind11.h>

#include "calls/session.h"

namespace meshrepair {

// Runs bodies of sessions, which touch nothing of Python's, on threads of their own. Meanwhile this
// thread, the lock released, wakes up some twenty times a second to call `told(stage, share)`,
// unless it is None, and to have Python look for signals. What these raise stops the work and
// leaves the function once the work has ended.
[[nodiscard]] Runner without_lock(const pybind11::object& told);

}  // namespace meshrepair
