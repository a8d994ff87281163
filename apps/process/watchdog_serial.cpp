// SPDX-License-Identifier: MIT
// In place of watchdog.cpp where there are no threads: the work alone asks whether to go on, and
// who started the program may end it from outside.
#include <utility>

#include "process/watchdog.h"

namespace meshrepair {

Watchdog::Watchdog(std::string program, const ProgressBar& progress)
    : program_(std::move(program)), progress_(progress) {}

Watchdog::~Watchdog() = default;

}  // namespace meshrepair
