// SPDX-License-Identifier: MIT
// A body whose openings cannot be sealed stays as it is.
#include "seal/seal_body.h"

#include <gtest/gtest.h>

#include <base/error.h>
#include <repair/repair.h>

#include "revolved.h"
#include "surfaces.h"

namespace meshrepair {
namespace {

using namespace testing;

// Slits so wide that each patch lies in one: so sealing is left to another repair.
RepairOptions sealing_with_repair(double size) {
  RepairOptions options;
  options.certify.precision = Precision::float32;
  options.slit_steps = 1 << 20;
  options.seal = {.size = size, .most_cubes = std::size_t{1} << 20};
  return options;
}

TEST(SealBody, BodyStaysWhereSealingGivesNoSolid) {
  const Surface body = as_surface(pierced_shell(0.1, 0.1, 48));
  const RepairOptions options = sealing_with_repair(0.27);
  std::size_t repaired = 0;
  RepairReport report;
  const auto in_vain = [&](const TriangleSoup&, const RepairOptions&, RepairReport&) -> Surface {
    ++repaired;
    throw NoSolidError("nothing is enclosed");
  };
  EXPECT_FALSE(internal::seal_body(body, 1, options, in_vain, report).has_value());
  EXPECT_EQ(repaired, 1u);
  EXPECT_EQ(report.seal.cannot_cut, 1u);
  EXPECT_EQ(report.seal.openings, 0u);
  EXPECT_EQ(report.seal.size, 0.27);
  EXPECT_FALSE(report.stages.empty());
}

TEST(SealBody, SealedBodyIsRepairedAgain) {
  const Surface body = as_surface(pierced_shell(0.1, 0.1, 48));
  const RepairOptions options = sealing_with_repair(0.27);
  RepairReport report;
  const auto as_it_is = [](const TriangleSoup& soup, const RepairOptions&, RepairReport&) {
    return as_surface(soup);
  };
  const auto sealed = internal::seal_body(body, 1, options, as_it_is, report);
  ASSERT_TRUE(sealed.has_value());
  EXPECT_EQ(report.seal.cannot_cut, 0u);
  EXPECT_EQ(report.seal.openings, 1u);
}

}  // namespace
}  // namespace meshrepair
