// SPDX-License-Identifier: MIT
// Waiting for a file, a pipe or a device in such a way that it can be ended.
#pragma once

#include <cerrno>
#include <poll.h>

#include <base/error.h>
#include <base/progress.h>

namespace meshrepair {

// Until the descriptor is ready for `events` (POLLIN, POLLOUT), or at fault. A signal that comes
// just before a call wakes nobody up, and a time limit does not at all: so the waiting is done
// here, in pieces, and `progress` is asked in between. Throws Cancelled.
inline void wait_for_descriptor(int descriptor, short events, ProgressObserver& progress) {
  constexpr int kMilliseconds = 100;
  pollfd waiting = {descriptor, events, 0};
  int ready = 0;
  do {
    if (progress.cancelled()) throw Cancelled();
    ready = ::poll(&waiting, 1, kMilliseconds);
  } while (ready == 0 || (ready < 0 && errno == EINTR));
}

}  // namespace meshrepair
