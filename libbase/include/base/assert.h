// SPDX-License-Identifier: MIT
// Assertion for our own invariants: active in every build, throws InternalError. Never for input.
#pragma once

#include <string>

#include <base/error.h>

namespace meshrepair {

[[noreturn]] inline void assertion_failed(const char* condition, const char* file, int line) {
  throw InternalError("internal error: " + std::string(condition) + " does not hold (" + file +
                      ":" + std::to_string(line) + ")");
}

}  // namespace meshrepair

#define MESHREPAIR_ASSERT(condition) \
  ((condition) ? void(0) : ::meshrepair::assertion_failed(#condition, __FILE__, __LINE__))
