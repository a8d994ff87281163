// SPDX-License-Identifier: MIT
// Waiting for a file, a pipe or a device in such a way that it can be ended.
#pragma once

#include <base/error.h>
#include <base/internal/system.h>
#include <base/progress.h>

namespace meshrepair {

// Until the descriptor is ready, or at fault. A signal that comes just before a call wakes nobody
// up, and a time limit does not at all: so the waiting is done here, in pieces, and `progress` is
// asked in between. Throws Cancelled.
inline void wait_for_descriptor(int descriptor, internal::Direction direction,
                                ProgressObserver& progress) {
  do {
    if (progress.cancelled()) throw Cancelled();
  } while (!internal::is_ready(descriptor, direction));
}

}  // namespace meshrepair
