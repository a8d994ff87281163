// SPDX-License-Identifier: MIT
#include "formats/common/text_scanner.h"

#include <bit>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "formats/common/text_writer.h"

namespace meshrepair {
namespace {

double number_in(const std::string& text) {
  TextScanner scanner(text);
  double value = 0;
  EXPECT_TRUE(scanner.next_anywhere() && scanner.read_real(value)) << text;
  EXPECT_EQ(scanner.remaining(), 0u) << text;
  return value;
}

TEST(ReadReal, PlainNumbers) {
  EXPECT_EQ(number_in("1.5"), 1.5);
  EXPECT_EQ(number_in("-1.5e-3"), -1.5e-3);
  EXPECT_EQ(number_in(".5"), 0.5);
  EXPECT_EQ(number_in("5."), 5.0);
  EXPECT_EQ(number_in("1E5"), 1e5);
  EXPECT_TRUE(std::signbit(number_in("-0")));
}

TEST(ReadReal, OddSpellings) {
  EXPECT_EQ(number_in("+1.5"), 1.5);
  EXPECT_EQ(number_in("1,5"), 1.5);
  EXPECT_EQ(number_in("-1,5E+2"), -150);
  EXPECT_EQ(number_in("1.5D-3"), 1.5e-3);
  EXPECT_TRUE(std::isnan(number_in("nan")));
  EXPECT_TRUE(std::isnan(number_in("-NaN")));
  EXPECT_TRUE(std::isnan(number_in("-nan(ind)")));
  EXPECT_TRUE(std::isnan(number_in("1.#QNAN")));
  EXPECT_TRUE(std::isnan(number_in("-1.#IND00")));
  EXPECT_EQ(number_in("1.#INF"), INFINITY);
  EXPECT_EQ(number_in("-1.#INF000e+000"), -INFINITY);
  EXPECT_EQ(number_in("-inf"), -INFINITY);
  EXPECT_EQ(number_in("+Infinity"), INFINITY);
}

TEST(ReadReal, BeyondTheRangeIsInfinityOrZero) {
  EXPECT_EQ(number_in("1e400"), INFINITY);
  EXPECT_EQ(number_in("-1e400"), -INFINITY);
  EXPECT_EQ(number_in("1e-400"), 0);
  EXPECT_EQ(number_in("1e99999999999999999999"), INFINITY);
  EXPECT_EQ(number_in("1e-99999999999999999999"), 0);
  EXPECT_EQ(number_in("0." + std::string(400, '0') + "1"), 0);
  EXPECT_EQ(number_in("1" + std::string(400, '0') + ".5"), INFINITY);
  EXPECT_EQ(number_in("0." + std::string(400, '0') + "1e401"), 1);
}

TEST(ReadReal, WordsAreNoNumbersAndAreLeftWhole) {
  for (const std::string word :
       {"x", "1x", "1.5.2", "1,234.5", "--1", "+-1", "+", "-", "1e", "0x10", "1/2", "#", "in"}) {
    TextScanner scanner(word);
    double value = 0;
    EXPECT_FALSE(scanner.read_real(value)) << word;
    EXPECT_TRUE(std::isnan(value)) << word;
    EXPECT_EQ(scanner.remaining(), 0u) << word;
  }
}

TEST(ReadInteger, ReadsIntegersBeforeOtherText) {
  const std::string text = "12/3/4 +5//6 7x -8 3.0 99999999999999999999";
  TextScanner scanner(text);
  std::int64_t value = 0;
  EXPECT_TRUE(scanner.next_on_line() && scanner.read_integer(value, '/'));
  EXPECT_EQ(value, 12);
  EXPECT_TRUE(scanner.next_on_line() && scanner.read_integer(value, '/'));
  EXPECT_EQ(value, 5);
  EXPECT_FALSE(scanner.next_on_line() && scanner.read_integer(value, '/'));
  EXPECT_TRUE(scanner.next_on_line() && scanner.read_integer(value));
  EXPECT_EQ(value, -8);
  EXPECT_TRUE(scanner.next_on_line() && scanner.read_integer(value));
  EXPECT_EQ(value, 3);
  EXPECT_FALSE(scanner.next_on_line() && scanner.read_integer(value));
  EXPECT_FALSE(scanner.next_on_line());
}

TEST(TextScanner, LinesEndInAllThreeWays) {
  TextScanner scanner("a b\nc\r\nd\re");
  std::string seen;
  for (int line = 0; line < 4; ++line) {
    for (; scanner.next_on_line(); scanner.skip_token()) seen += scanner.peek_token();
    seen += '|';
    scanner.skip_line();
  }
  EXPECT_EQ(seen, "ab|c|d|e|");
}

TEST(TextScanner, CommentEndsTheLineAtTheStartOfATokenOnly) {
  TextScanner scanner("a#b #c\nd", {.comment = '#'});
  EXPECT_TRUE(scanner.next_on_line());
  EXPECT_EQ(scanner.peek_token(), "a#b");
  EXPECT_EQ(scanner.tokens_on_line(), 1u);
  scanner.skip_token();
  EXPECT_FALSE(scanner.next_on_line());
  EXPECT_TRUE(scanner.next_anywhere());
  EXPECT_EQ(scanner.peek_token(), "d");
}

TEST(AppendNumber, DigitsReadBackAsTheSameBits) {
  for (const double value :
       {0.1, 1.0 / 3, 1e300, 5e-324, -0.0, 123456789.0, 0x1.fffffffffffffp+1023}) {
    std::string text;
    append_number(text, value);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(number_in(text)), std::bit_cast<std::uint64_t>(value))
        << text;
  }
}

}  // namespace
}  // namespace meshrepair
