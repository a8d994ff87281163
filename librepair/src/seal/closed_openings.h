// SPDX-License-Identifier: MIT
// What lies behind openings of a solid becomes solid: exactly, once it is known where they are.
#pragma once

#include <cstddef>
#include <memory>

#include <bsp/clean_soup.h>
#include <extract/arrange.h>
#include <extract/surface.h>
#include <repair/seal_openings.h>

#include "again/second_repair.h"
#include "fill_behind.h"

namespace meshrepair::internal {

// The surface and the lattice on the working grid, and which chambers are solid then. Stays where
// it is, as the arrangement refers to the soup.
struct ClosedOpenings {
  SecondSoup second;
  CleanSoup soup;
  std::unique_ptr<Arrangement> arrangement;
  FilledChambers filled;
};

// A body among others, when some of its openings may be closed already.
struct SealedSoFar {
  std::size_t bodies = 1;
  double size = 0;  // only larger ones are tried
};

// What is tried where no size is given is at most this share of the diagonal.
inline constexpr double kLargestShareTried = 1.0 / 8;

// As the options say, whose size is no share; nothing if there is nothing to close. Throws
// UsageError where the size that is asked for takes too many cubes.
[[nodiscard]] std::unique_ptr<ClosedOpenings> close_openings(const Surface& body,
                                                             const SealOptions& options,
                                                             const SealedSoFar& before,
                                                             SealReport& report,
                                                             ProgressObserver* progress);

// What was closed of another body, or with another size.
void add_seal(const SealReport& more, SealReport& report);

}  // namespace meshrepair::internal
