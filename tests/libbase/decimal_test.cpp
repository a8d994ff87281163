// SPDX-License-Identifier: MIT
// What stands in for numbers of floating point in <charconv> does as they do.
#include <version>

#include <gtest/gtest.h>

#if __has_include(<fast_float/fast_float.h>) && defined(__SIZEOF_INT128__) && \
    defined(__cpp_lib_to_chars)

#define FMT_HEADER_ONLY
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "real_digits.h"
#include "share_of_cases.h"

using namespace meshrepair::internal;

namespace {

template <class Real>
std::string by_std(Real value) {
  std::array<char, 64> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

template <class Real>
std::string by_us(Real value) {
  std::array<char, 64> text;
  return {text.data(), write_real_digits(text.data(), text.data() + text.size(), value).ptr};
}

void expect_read_alike(const std::string& text) {
  double expected = -7;
  double value = -7;
  const char* const end = text.data() + text.size();
  const auto a = std::from_chars(text.data(), end, expected);
  const auto b = read_real_digits(text.data(), end, value);
  EXPECT_EQ(a.ec, b.ec) << text;
  EXPECT_EQ(a.ptr - text.data(), b.ptr - text.data()) << text;
  EXPECT_EQ(std::bit_cast<std::uint64_t>(expected), std::bit_cast<std::uint64_t>(value)) << text;
}

TEST(Decimal, AllBitsAreWrittenAndReadAsByTheStandardLibrary) {
  std::mt19937_64 random(1);
  for (std::size_t i = 0; i < meshrepair::share_of_cases(std::size_t{200000}); ++i) {
    const auto value = std::bit_cast<double>(random());
    const auto single = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    if (std::isnan(value) || std::isnan(single)) continue;
    ASSERT_EQ(by_us(value), by_std(value));
    ASSERT_EQ(by_us(single), by_std(single));
    expect_read_alike(by_std(value));
  }
}

TEST(Decimal, NumbersOfMeshesAreWrittenAsByTheStandardLibrary) {
  std::mt19937_64 random(2);
  for (std::size_t i = 0; i < meshrepair::share_of_cases(std::size_t{200000}); ++i) {
    const auto whole = static_cast<double>(static_cast<std::int64_t>(random()) >> (random() % 63));
    double value = whole;
    for (std::uint64_t k = random() % 12; k > 0; --k) value /= 10;
    for (const double each : {value, whole, whole * 1e4, std::ldexp(whole, -30)}) {
      ASSERT_EQ(by_us(each), by_std(each));
      const auto single = static_cast<float>(each);
      ASSERT_EQ(by_us(single), by_std(single));
    }
  }
}

TEST(Decimal, EveryPowerOfTenIsLaidOutAlike) {
  for (int exponent = -323; exponent <= 308; ++exponent) {
    for (const char* const digits : {"1", "12", "9.99", "1.2345678901234567", "-5.5"}) {
      const double value = std::stod(digits) * std::pow(10.0, exponent);
      EXPECT_EQ(by_us(value), by_std(value));
    }
  }
}

TEST(Decimal, OddWordsAreReadAlike) {
  for (const char* const text : {"",
                                 "-",
                                 "+1",
                                 "1e",
                                 "1e+",
                                 "1.",
                                 ".5",
                                 ".",
                                 "-.5e-3x",
                                 "inf",
                                 "-inf",
                                 "nan",
                                 "-nan",
                                 "0x10",
                                 "1e400",
                                 "-1e400",
                                 "1e-400",
                                 "-0",
                                 "0e999",
                                 "1,5",
                                 "1d5",
                                 "infinity",
                                 "INF",
                                 "1e99999",
                                 "00012",
                                 "4.9e-324",
                                 "2e-324",
                                 "1.7976931348623159e308",
                                 "123456789012345678901234567890",
                                 "1e-99999999999999999999"}) {
    expect_read_alike(text);
  }
}

TEST(Decimal, WhatDoesNotFitIsSaid) {
  std::array<char, 4> text;
  EXPECT_EQ(write_real_digits(text.data(), text.data() + text.size(), 1.2345).ec,
            std::errc::value_too_large);
}

}  // namespace

#else

TEST(Decimal, IsTestedWhereFastFloatAndFullCharconvAre) {
  GTEST_SKIP() << "one of both is missing";
}

#endif
