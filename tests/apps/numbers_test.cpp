// SPDX-License-Identifier: MIT
#include "options/numbers.h"

#include <cmath>

#include <gtest/gtest.h>

namespace meshrepair {
namespace {

TEST(Numbers, AreDecimal) {
  EXPECT_EQ(parse_number("0.5"), 0.5);
  EXPECT_EQ(parse_number("+2"), 2);
  EXPECT_EQ(parse_number("-1e-3"), -1e-3);
  EXPECT_EQ(parse_number(".5"), 0.5);
  EXPECT_TRUE(std::isnan(parse_number("nan").value()));
  for (const char* word : {"", "+", "+-1", "0x10", "1,5", "1 ", " 1", "1e", "one", "1%"}) {
    EXPECT_FALSE(parse_number(word)) << word;
  }
}

TEST(Numbers, CountsAreDigitsAlone) {
  EXPECT_EQ(parse_count("10"), 10U);
  EXPECT_EQ(parse_count("010"), 10U);
  for (const char* word : {"", "-1", "+1", "1.0", "0x10", "99999999999999999999"}) {
    EXPECT_FALSE(parse_count(word)) << word;
  }
}

TEST(Numbers, WhatIsOutOfRangeIsSaid) {
  EXPECT_EQ(count_between(1, 3)("3"), "");
  EXPECT_EQ(count_between(1, 3)("4"), "'4' is not a whole number from 1 to 3");
  EXPECT_EQ(count_between(5)("x"), "'x' is not a whole number from 5 on");
  EXPECT_EQ(number_between(0.1, 1000)("0.1"), "");
  EXPECT_EQ(number_between(0.1, 1000)("0x10"), "'0x10' is not a number from 0.1 to 1000");
  EXPECT_EQ(number_between(0)("inf"), "'inf' is not a number from 0 on");
}

}  // namespace
}  // namespace meshrepair
