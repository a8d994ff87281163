// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <set>
#include <string_view>

#include <gtest/gtest.h>

#include <base/warning.h>

namespace meshrepair {
namespace {

TEST(WarningKinds, HaveCodesOfOneFormThatDifferAndSayWhatTheyMean) {
  std::set<std::string_view> codes;
  for (const WarningKind& kind : warning_kinds()) {
    EXPECT_THAT(kind.code, ::testing::MatchesRegex("W-[A-Z0-9]+(-[A-Z0-9]+)*"));
    EXPECT_TRUE(codes.insert(kind.code).second) << kind.code;
    EXPECT_GT(kind.meaning.size(), 20U) << kind.code;
    EXPECT_NE(kind.meaning.back(), '.') << kind.code;
  }
  EXPECT_EQ(kind_of(WarningCode::file_cut_off).code, "W-FILE-CUT-OFF");
  EXPECT_EQ(kind_of(WarningCode::report_not_written).code, "W-REPORT-NOT-WRITTEN");
}

}  // namespace
}  // namespace meshrepair
