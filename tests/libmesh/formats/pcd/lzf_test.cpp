// SPDX-License-Identifier: MIT
#include "formats/pcd/lzf.h"

#include <gtest/gtest.h>

namespace meshrepair {
namespace {

using namespace std::string_view_literals;

TEST(Lzf, LiteralsAreCopied) { EXPECT_EQ(expand_lzf("\x02\x61\x62\x63"sv, 3), "abc"); }

TEST(Lzf, ACopyMayRepeatItself) {
  // "ab", then 6 bytes from 2 before.
  EXPECT_EQ(expand_lzf("\x01\x61\x62\x80\x01"sv, 8), "abababab");
}

TEST(Lzf, LongCopiesHaveALengthByte) {
  // 'z', then 7 + 3 + 2 bytes from 1 before.
  EXPECT_EQ(expand_lzf("\x00\x7A\xE0\x03\x00"sv, 13), std::string(13, 'z'));
}

TEST(Lzf, DamageIsNoticed) {
  EXPECT_EQ(expand_lzf("\x05\x61"sv, 6), std::nullopt);           // literal cut
  EXPECT_EQ(expand_lzf("\x20\x00"sv, 3), std::nullopt);           // from before the beginning
  EXPECT_EQ(expand_lzf("\x00\x61\x20"sv, 4), std::nullopt);       // distance cut
  EXPECT_EQ(expand_lzf("\x00\x61\xE0\x00"sv, 10), std::nullopt);  // distance cut after a length
  EXPECT_EQ(expand_lzf("\x02\x61\x62\x63"sv, 2), std::nullopt);   // more than promised
  EXPECT_EQ(expand_lzf("\x02\x61\x62\x63"sv, 4), std::nullopt);   // less
}

TEST(Lzf, AnImpossibleSizeTakesNoMemory) {
  EXPECT_EQ(expand_lzf("\x00\x61"sv, std::size_t{1} << 60), std::nullopt);
}

}  // namespace
}  // namespace meshrepair
