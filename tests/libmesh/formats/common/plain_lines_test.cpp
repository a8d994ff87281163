// SPDX-License-Identifier: MIT
#include "formats/common/plain_lines.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

#include <gtest/gtest.h>

namespace meshrepair {
namespace {

struct Read {
  std::vector<int> numbers;
  std::size_t position = 0;
};

Read read_numbers(const std::string& text, std::size_t most, std::size_t position = 0) {
  Read read;
  read.position = read_plain_lines<int>(
      text, position,
      [](PlainLine& line, int& number) {
        return line.letter('n') && line.blanks() && line.number(number) && line.ends();
      },
      [&](std::span<const int> items, std::size_t behind) {
        EXPECT_LE(behind, text.size());
        const std::size_t count = std::min(items.size(), most - read.numbers.size());
        read.numbers.insert(read.numbers.end(), items.begin(),
                            items.begin() + static_cast<std::ptrdiff_t>(count));
        return count;
      });
  return read;
}

constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

std::string lines(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += "n " + std::to_string(i) + (i % 3 == 0 ? " \r\n" : "\n");
  return text;
}

std::vector<int> first_numbers(int count) {
  std::vector<int> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

TEST(ReadPlainLines, EndBeforeTheFirstOneThatIsNotPlain) {
  for (const int count : {0, 1, 500, 1000, 10'000, 300'000}) {
    const std::string plain = lines(count);
    for (const char* rest : {"m 7\n", "n 7 7\n", "n\n7\n", "\n", "n 7\\\n", "n 7#\n", "n 7.5\n",
                             "n +7\n", "n 7\r\r\n", "# n\n", " n 7\n"}) {
      const Read read = read_numbers(plain + rest + "n 8\n", kAll);
      EXPECT_EQ(read.position, plain.size()) << count << rest;
      EXPECT_EQ(read.numbers, first_numbers(count)) << count << rest;
    }
  }
}

TEST(ReadPlainLines, EndWhereNoMoreAreTaken) {
  const std::string text = lines(200'000);
  for (const int most : {0, 1, 600, 70'000, 199'999, 200'000}) {
    const Read read = read_numbers(text, static_cast<std::size_t>(most));
    EXPECT_EQ(read.position, lines(most).size()) << most;
    EXPECT_EQ(read.numbers, first_numbers(most)) << most;
  }
}

TEST(ReadPlainLines, BeginAnywhere) {
  const Read read = read_numbers("junk n 1\nn 2\n", kAll, 5);
  EXPECT_EQ(read.numbers, (std::vector<int>{1, 2}));
}

TEST(ReadPlainLines, LeaveALineWithoutItsEndToTheReader) {
  EXPECT_EQ(read_numbers("n 1\nn 2", kAll).position, 4U);
  EXPECT_EQ(read_numbers("n 1", kAll).position, 0U);
  EXPECT_EQ(read_numbers("", kAll).position, 0U);
}

}  // namespace
}  // namespace meshrepair
