// SPDX-License-Identifier: MIT
#include "process/memory_limit.h"

#include <string>

#include <gtest/gtest.h>

#include <base/error.h>
#include <base/internal/system.h>

namespace meshrepair {
namespace {

std::uint64_t bytes_of(const std::string& text) { return parse_memory_limit(text).bytes; }

TEST(MemoryLimit, UnitsArePowersOf1024) {
  EXPECT_EQ(bytes_of("0"), 0u);
  EXPECT_EQ(bytes_of("123"), 123u);
  EXPECT_EQ(bytes_of("123B"), 123u);
  EXPECT_EQ(bytes_of("2K"), 2048u);
  EXPECT_EQ(bytes_of("200M"), 200u << 20);
  EXPECT_EQ(bytes_of("200mb"), 200u << 20);
  EXPECT_EQ(bytes_of("1.5GiB"), std::uint64_t{3} << 29);
  EXPECT_EQ(bytes_of("1T"), std::uint64_t{1} << 40);
  EXPECT_FALSE(parse_memory_limit("200M").is_share);
}

TEST(MemoryLimit, AShareIsOfWhatIsFree) {
  const auto free = internal::free_memory();
  if (!free) GTEST_SKIP() << "the system does not tell how much memory is free";
  const MemoryLimit half = parse_memory_limit("50%");
  EXPECT_TRUE(half.is_share);
  // What is free changes from one moment to the next.
  EXPECT_GT(half.bytes, *free / 4);
  EXPECT_LT(half.bytes, *free);
}

TEST(MemoryLimit, AnythingElseIsRefused) {
  for (const char* text : {"", "M", "-1", "-5M", "nan", "inf", "1e30", "200Q", "200 M", "200Mx",
                           "101%", "-1%", "0%", "50%%", "0.5", "1e-4K", "0x10", "%"}) {
    EXPECT_THROW((void)parse_memory_limit(text), UsageError) << text;
  }
}

TEST(MemoryLimit, ASizeIsNoShareAndNamesItsOption) {
  EXPECT_EQ(parse_size("200M", "--max-upload"), 200u << 20);
  for (const char* text : {"", "50%", "-1", "200Q"}) {
    try {
      (void)parse_size(text, "--max-upload");
      ADD_FAILURE() << text;
    } catch (const UsageError& error) {
      EXPECT_EQ(std::string(error.what()).rfind("--max-upload: ", 0), 0u) << error.what();
    }
  }
}

// What a group leaves is never taken for no limit.
TEST(MemoryLimit, AShareOfNearlyNothingIsALimit) { EXPECT_GT(bytes_of("1e-15%"), 0u); }

TEST(MemoryLimit, IsToldInUnits) {
  EXPECT_EQ(memory_text(200u << 20), "200 MB");
  EXPECT_EQ(memory_text(1000), "1000 bytes");
  EXPECT_EQ(memory_text(std::uint64_t{3} << 29), "1.5 GB");
}

TEST(MemoryLimit, TheProcessIsInMemory) {
  const std::uint64_t resident = internal::process_memory().resident;
  if (resident == 0) GTEST_SKIP() << "the system does not tell";
  EXPECT_GT(resident, 1u << 20);
}

}  // namespace
}  // namespace meshrepair
