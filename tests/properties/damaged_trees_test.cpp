// SPDX-License-Identifier: MIT
// Tree files that are damaged under a right checksum, through the rest of the pipeline.
#include <array>
#include <string>

#include <gtest/gtest.h>

#include <base/error.h>
#include <bsp/tree_io.h>
#include <repair/repair.h>

#include "degenerate_soups.h"
#include "share_of_cases.h"
#include "tree_bytes.h"

namespace meshrepair {
namespace {

using namespace testing;

// What may become of a file: it is refused, encloses nothing, or gives a mesh.
enum class Fate { refused, empty, mesh };

template <class Work>
Fate fate_of(Work work) {
  try {
    work();
  } catch (const InputError&) {
    return Fate::refused;
  } catch (const NoSolidError&) {
    return Fate::empty;
  }
  return Fate::mesh;
}

std::string labelled_bytes(const TriangleSoup& soup) {
  RepairReport report;
  Tree tree = make_tree(soup, {}, report);
  label_tree(tree, {}, report);
  return format_tree(tree);
}

// Input never trips an assert: anything but the two exceptions above ends the test.
TEST(DamagedTrees, AreRefusedOrExtracted) {
  const std::array<std::string, 4> files = {
      labelled_bytes(cube()), labelled_bytes(random_grid_boxes(4, 5, 1)),
      labelled_bytes(tetrahedra_soup(5, 2)), labelled_bytes(noisy_sphere(80, 0.2, 3))};
  std::array<int, 3> fates{};
  for (std::uint64_t seed = 0; seed < share_of_cases(3000u); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::string bytes = files[seed % files.size()];
    damage_section(bytes, random);
    Tree tree;
    const Fate read = fate_of([&] { tree = parse_tree(bytes, "some.bsp"); });
    if (read != Fate::mesh) {
      ++fates[0];
      continue;
    }
    RepairReport report;
    Fate fate = Fate::refused;
    ASSERT_NO_THROW(fate = fate_of([&] { (void)extract_mesh(tree, {}, report); }));
    ++fates[static_cast<std::size_t>(fate)];
    ASSERT_NO_THROW((void)fate_of([&] { label_tree(tree, {}, report); }));
  }
  EXPECT_GT(fates[static_cast<std::size_t>(Fate::refused)], expected_cases(100));
  EXPECT_GT(fates[static_cast<std::size_t>(Fate::mesh)], expected_cases(100));
}

}  // namespace
}  // namespace meshrepair
