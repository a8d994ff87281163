// What lies behind openings of a solid becomes solid: exactly, once it is known where they are.
#pragma once

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

// As the options say; nothing if there is nothing to close. Throws UsageError where the size that
// is asked for takes too many cubes.
[[nodiscard]] std::unique_ptr<ClosedOpenings> close_openings(const Surface& solid,
                                                             const SealOptions& options,
                                                             SealReport& report,
                                                             ProgressObserver* progress);

}  // namespace meshrepair::internal
