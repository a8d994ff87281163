// SPDX-License-Identifier: MIT
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>
#include <bsp/tree_io.h>
#include <mesh/recognize_format.h>

#include "each_seed.h"
#include "shapes.h"
#include "share_of_cases.h"
#include "temporary_folder.h"
#include "tree_bytes.h"
#include "trees.h"

namespace meshrepair {
namespace {

using namespace testing;

constexpr std::array<std::string_view, 7> kNames = {"GRID", "PNTS", "TRIS", "PLNS",
                                                    "NODE", "NTRI", "LEAF"};

Tree labelled_tree(const TriangleSoup& soup, std::uint64_t seed) {
  Random random(seed);
  Tree tree = tree_of(soup);
  for (Leaf& leaf : tree.leaves) {
    leaf = {static_cast<Label>(random.integer(0, 2)), static_cast<float>(random.real(0, 1))};
  }
  return tree;
}

// Empty when the bytes are accepted.
std::string refusal(std::string_view bytes) {
  try {
    (void)parse_tree(bytes, "some.bsp");
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

std::string refusal_with(std::string bytes, std::size_t section, std::size_t offset,
                         std::uint32_t value) {
  const Section s = sections_of(bytes)[section];
  put_at(bytes, s.begin + offset, value);
  mend_checksum(bytes, s);
  return refusal(bytes);
}

TEST(TreeIo, WhatIsReadIsWhatWasWritten) {
  std::vector<TriangleSoup> soups = {cube(), TriangleSoup{}, noisy_sphere(300, 0.1, 1),
                                     random_soup(60, 4, 2),
                                     scaled(sphere(100, 1, {1e9, -3, 0.1}), 1e250)};
  for (std::uint64_t i = 0; i < soups.size(); ++i) {
    SCOPED_TRACE(i);
    const Tree tree = labelled_tree(soups[i], i);
    const std::string bytes = format_tree(tree);
    EXPECT_TRUE(looks_like_tree(bytes));
    const Tree again = parse_tree(bytes, "some.bsp");
    EXPECT_EQ(format_tree(again), bytes);
    EXPECT_EQ(again.nodes.size(), tree.nodes.size());
    EXPECT_EQ(again.root.bits(), tree.root.bits());
    for (PointId p(0u); p < tree.input.points.end_id(); ++p.value) {
      EXPECT_EQ(again.input.points[p], tree.input.points[p]);
      EXPECT_EQ(again.input.grid_points[p], tree.input.grid_points[p]);
    }
    for (PlaneId p(0u); p.index() < tree.input.planes.size(); ++p.value) {
      EXPECT_TRUE(same_coefficients(again.input.planes[p], tree.input.planes[p]));
      EXPECT_EQ(again.input.planes[p].unit, tree.input.planes[p].unit);
    }
  }
}

TEST(TreeIo, LayoutIsAsDocumented) {
  const std::string bytes = format_tree(labelled_tree(cube(), 1));
  EXPECT_EQ(bytes.substr(0, 8), std::string_view("BSP\r\n\x1A\n\0", 8));
  EXPECT_EQ(number_at<std::uint32_t>(bytes, 8), 1u);
  EXPECT_EQ(number_at<std::uint32_t>(bytes, 12), 7u);
  const std::vector<Section> sections = sections_of(bytes);
  ASSERT_EQ(sections.size(), kNames.size());
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const Section& s = sections[i];
    EXPECT_EQ(std::string_view(bytes).substr(s.header, 4), kNames[i]);
    EXPECT_EQ(number_at<std::uint64_t>(bytes, s.header + 16),
              checksum(std::string_view(bytes).substr(s.begin, s.end - s.begin)));
  }
}

TEST(TreeIo, FilesRoundTrip) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "cube.bsp";
  const Tree tree = labelled_tree(cube(), 2);
  write_tree(tree, path);
  EXPECT_EQ(format_tree(read_tree(path)), format_tree(tree));
  EXPECT_EQ(std::filesystem::file_size(path), format_tree(tree).size());
  EXPECT_THROW((void)read_tree(folder.path() / "none.bsp"), InputError);
  EXPECT_THROW(write_tree(tree, folder.path() / "none" / "cube.bsp"), OutputError);
}

TEST(TreeIo, EveryTruncationIsRefusedNamingTheSection) {
  const std::string bytes = format_tree(labelled_tree(random_soup(6, 3, 1), 3));
  const std::vector<Section> sections = sections_of(bytes);
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    SCOPED_TRACE(length);
    // A copy of its own, so that a read past the end is one past the end of the memory.
    const std::vector<char> cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
    const std::string why = refusal({cut.data(), cut.size()});
    ASSERT_NE(why, "");
    EXPECT_EQ(why.rfind("some.bsp: ", 0), 0u) << why;
    if (length < kHeaderBytes) continue;
    std::size_t broken = 0;
    while (sections[broken].end <= length) ++broken;
    EXPECT_NE(why.find("section " + std::string(kNames[broken])), std::string::npos) << why;
  }
}

TEST(TreeIo, MoreBytesThanThereShouldBeAreRefused) {
  std::string bytes = format_tree(labelled_tree(cube(), 4));
  EXPECT_NE(refusal(bytes + '\0'), "");
  EXPECT_NE(refusal(bytes + bytes), "");
}

TEST(TreeIo, OtherFilesAreRefused) {
  EXPECT_NE(refusal(""), "");
  EXPECT_NE(refusal("solid cube\n"), "");
  EXPECT_FALSE(looks_like_tree("solid cube\n"));
  EXPECT_FALSE(looks_like_tree(""));
  std::string bytes = format_tree(labelled_tree(cube(), 5));
  put_at(bytes, 8, std::uint32_t{2});
  EXPECT_NE(refusal(bytes).find("version 2"), std::string::npos);
}

// A changed byte is found by a checksum or breaks a header.
TEST(TreeIo, EveryChangedByteIsRefused) {
  const std::string bytes = format_tree(labelled_tree(random_soup(6, 3, 2), 6));
  Random random(1);
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    SCOPED_TRACE(at);
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ random.integer(1, 255));
    EXPECT_NE(refusal(damaged), "");
  }
}

// Damage that a checksum hides: refused, or a tree that holds together and can be written again.
TEST(TreeIo, DamageUnderARightChecksumIsRefusedOrHarmless) {
  std::size_t refused = 0, accepted = 0;
  for_each_seed(6000, [&](std::uint64_t seed) {
    Random random(seed);
    static const std::array<std::string, 3> files = {
        format_tree(labelled_tree(cube(), 7)), format_tree(labelled_tree(random_soup(12, 3, 3), 8)),
        format_tree(labelled_tree(random_soup(20, 1000000, 4), 9))};
    std::string bytes = files[seed % files.size()];
    damage_section(bytes, random);
    const std::vector<char> exact(bytes.begin(), bytes.end());
    if (!refusal({exact.data(), exact.size()}).empty()) {
      ++refused;
      return;
    }
    ++accepted;
    const Tree tree = parse_tree(bytes, "some.bsp");
    EXPECT_EQ(tree.leaves.size(), tree.nodes.size() + 1);
    EXPECT_EQ(refusal(format_tree(tree)), "");
  });
  EXPECT_GT(refused, expected_cases(1000u));
  EXPECT_GT(accepted, expected_cases(100u));
}

// Headers that lie: about the size of an item, the number of items.
TEST(TreeIo, LyingCountsAreRefused) {
  const std::string bytes = format_tree(labelled_tree(cube(), 10));
  const std::vector<Section> sections = sections_of(bytes);
  for (std::size_t i = 0; i < sections.size(); ++i) {
    SCOPED_TRACE(kNames[i]);
    const std::size_t header = sections[i].header;
    const auto items = number_at<std::uint64_t>(bytes, header + 8);
    for (const std::uint64_t lie :
         {items + 1, items - 1, std::uint64_t{0}, ~std::uint64_t{0}, std::uint64_t{1} << 63,
          std::uint64_t{1} << 31, std::uint64_t{1} << 60, ~std::uint64_t{0} / 36 + 1}) {
      if (lie == items) continue;
      std::string damaged = bytes;
      put_at(damaged, header + 8, lie);
      EXPECT_NE(refusal(damaged), "") << lie;
    }
    for (const std::uint32_t lie : {0u, 1u, ~0u}) {
      std::string damaged = bytes;
      put_at(damaged, header + 4, lie);
      EXPECT_NE(refusal(damaged), "") << lie;
    }
  }
}

TEST(TreeIo, CyclesAreRefused) {
  const std::string bytes = format_tree(labelled_tree(cube(), 11));
  const Section nodes = sections_of(bytes)[4];
  const std::size_t count = (nodes.end - nodes.begin) / 20;
  ASSERT_GE(count, 3u);
  for (std::size_t n = 0; n < count; ++n) {
    for (std::uint32_t to = 0; to <= n; ++to) {
      for (const std::size_t child : {std::size_t{4}, std::size_t{8}}) {
        const std::string why = refusal_with(bytes, 4, 20 * n + child, to);
        EXPECT_NE(why, "") << n << " to " << to;
        EXPECT_NE(why.find("parent"), std::string::npos) << why;
      }
    }
  }
}

TEST(TreeIo, DanglingAndRepeatedReferencesAreRefused) {
  const std::string bytes = format_tree(labelled_tree(cube(), 12));
  const std::uint32_t leaf_bit = std::uint32_t{1} << 31;
  for (const std::uint32_t ref : {1000u, leaf_bit | 1000u, leaf_bit - 1, ~0u}) {
    EXPECT_NE(refusal_with(bytes, 4, 4, ref), "") << ref;
  }
  // Both children of the root alike.
  const Section nodes = sections_of(bytes)[4];
  EXPECT_NE(refusal_with(bytes, 4, 8, number_at<std::uint32_t>(bytes, nodes.begin + 4)), "");
  EXPECT_NE(refusal_with(bytes, 4, 0, 1000000), "");   // plane of a node
  EXPECT_NE(refusal_with(bytes, 4, 12, 1000000), "");  // its triangles
  EXPECT_NE(refusal_with(bytes, 4, 16, ~0u), "");
  EXPECT_NE(refusal_with(bytes, 5, 0, 1000000), "");      // a triangle at a node
  EXPECT_NE(refusal_with(bytes, 2, 0, 1000000), "");      // a corner of a triangle
  EXPECT_NE(refusal_with(bytes, 2, 12, 1000000), "");     // its plane
  EXPECT_NE(refusal_with(bytes, 2, 16, 0x7FFFFFFF), "");  // its winding
  EXPECT_NE(refusal_with(bytes, 1, 24, 0x7FFFFFFF), "");  // a grid coordinate
  EXPECT_NE(refusal_with(bytes, 6, 0, 3), "");            // a label
  EXPECT_NE(refusal_with(bytes, 6, 4, 0x7FC00000), "");   // a confidence of NaN
  EXPECT_NE(refusal_with(bytes, 0, 28, 0x3FF80000), "");  // a unit of 1.5 or so
}

// They would be written where no decision was made for them: what encloses may be turned inside
// out.
TEST(TreeIo, PointsAwayFromTheirPlaceOnTheGridAreRefused) {
  const std::string bytes = format_tree(labelled_tree(cube(), 13));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t high_word = 8 * axis + 4;
    for (const std::uint32_t to : {0x40000000u, 0xC0000000u, 0x7FE00000u}) {
      const std::string why = refusal_with(bytes, 1, high_word, to);
      EXPECT_NE(why.find("PNTS"), std::string::npos) << why;
    }
  }
}

}  // namespace
}  // namespace meshrepair
