// SPDX-License-Identifier: MIT
// How many cases a test of a property at random tries.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace meshrepair {

// The environment variable MESHREPAIR_TEST_SHARE, 0.1 say where each case takes long, as under
// sanitizers; else 1.
[[nodiscard]] inline double tried_share() {
  static const double share = [] {
    const char* text = std::getenv("MESHREPAIR_TEST_SHARE");
    const double value = text == nullptr ? 1 : std::atof(text);
    return value > 0 && value < 1 ? value : 1;
  }();
  return share;
}

// How many of all cases are tried, at least one: the first ones, so what a case is does not depend
// on the share.
template <class Number>
[[nodiscard]] Number share_of_cases(Number all) {
  return std::max(Number(1),
                  static_cast<Number>(std::ceil(static_cast<double>(all) * tried_share())));
}

// Of how many cases something is expected, if it is of `of_all` when all are tried: of half the
// share otherwise, as the first ones may differ from the rest.
template <class Number>
[[nodiscard]] Number expected_cases(Number of_all) {
  if (tried_share() == 1) return of_all;
  return static_cast<Number>(static_cast<double>(of_all) * tried_share() / 2);
}

}  // namespace meshrepair
