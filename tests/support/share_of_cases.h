// How many cases a test of a property at random tries.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace meshrepair {

// All of them, or the share that the environment variable MESHREPAIR_TEST_SHARE names, 0.1 say,
// where each case takes long, as under sanitizers. At least one; the first ones, so what a case is
// does not depend on the share.
template <class Number>
[[nodiscard]] Number share_of_cases(Number all) {
  static const double share = [] {
    const char* text = std::getenv("MESHREPAIR_TEST_SHARE");
    const double value = text == nullptr ? 1 : std::atof(text);
    return value > 0 && value < 1 ? value : 1;
  }();
  return std::max(Number(1), static_cast<Number>(std::ceil(static_cast<double>(all) * share)));
}

}  // namespace meshrepair
