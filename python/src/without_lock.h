// SPDX-License-Identifier: MIT
// How a call from Python works without Python's lock, and can be interrupted.
#pragma once

#include <pybind11/pybind11.h>

#include "calls/session.h"

namespace meshrepair {

// Runs bodies of sessions, which touch nothing of Python's, on threads of their own. Meanwhile this
// thread, the lock released, wakes up some twenty times a second to call `told(stage, share)`,
// unless it is None, and to have Python look for signals. What these raise stops the work and
// leaves the function once the work has ended.
// Once Python ends, work is asked to stop, and new work stops at once.
[[nodiscard]] Runner without_lock(const pybind11::object& told);

// Has Python call, when it begins to end, what asks all work to stop, and waits for that: a thread
// that comes for Python's lock later is killed, whatever C++ it is in the middle of.
void stop_work_at_exit();

}  // namespace meshrepair
