// SPDX-License-Identifier: MIT
// A thread for the work of a call, while the one that called looks after its caller.
#pragma once

#include <functional>

namespace meshrepair {

// Runs `work` on another thread, one with a large stack and the C locale, or on this one where
// there are no others. Meanwhile this thread calls `look` some twenty times a second; where it
// throws, it is called no more, and is to have seen to it that the work ends soon. Returns once the
// work has ended, and throws what `look` threw, else what `work` threw; OutOfThreads where there is
// no thread.
void run_watched(const std::function<void()>& work, const std::function<void()>& look);

// To be called by the work every few milliseconds: where there are no other threads, this is when
// `look` is called.
void let_look();

}  // namespace meshrepair
