// SPDX-License-Identifier: MIT
// The cases of a test of a property at random.
#pragma once

#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "share_of_cases.h"

namespace meshrepair {

// Calls f(seed) for share_of_cases(count) seeds, from `first` on: of what fails the seed is told. A
// fatal failure is the last.
template <class Function>
void for_each_seed(std::uint64_t first, std::uint64_t count, const Function& f) {
  const std::uint64_t tried = share_of_cases(count);
  for (std::uint64_t seed = first; seed < first + tried; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    f(seed);
    if (::testing::Test::HasFatalFailure()) return;
  }
}

template <class Function>
void for_each_seed(std::uint64_t count, const Function& f) {
  for_each_seed(0, count, f);
}

}  // namespace meshrepair
