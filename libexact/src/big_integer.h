// SPDX-License-Identifier: MIT
// Integers of up to 6,600 bits, for determinants of doubles of any magnitude. Boost's cpp_int of a
// fixed size gives the same signs in about twice the time: to check a mesh with rounding noise
// beside the axes takes 1.4 times as long.
#pragma once

#include <array>
#include <cstdint>

namespace meshrepair::internal {

// Sign and magnitude, 64-bit words, lowest first, in place: no allocation, and what a result costs
// depends on its own length. Operations are exact while the result fits, which the callers prove.
class BigInteger {
 public:
  // The doubles are integers times 2^-1074; of 2^1024 / 2^-1074 < 2^2112 (33 words) a difference
  // has 33 words, a minor 67, a determinant of three rows 101, the sum of 2^32 of them 102.
  static constexpr int kWords = 104;
  static constexpr int kSmallestExponent = -1074;

  BigInteger() {}
  BigInteger(const BigInteger& other) { *this = other; }
  BigInteger& operator=(const BigInteger& other);

  // value / 2^exponent, for a finite value that is a multiple of 2^exponent.
  BigInteger(double value, int exponent);

  [[nodiscard]] int sign() const { return sign_; }

  friend BigInteger operator+(const BigInteger& a, const BigInteger& b);
  friend BigInteger operator-(const BigInteger& a, const BigInteger& b);
  friend BigInteger operator*(const BigInteger& a, const BigInteger& b);

 private:
  [[nodiscard]] static int compare_magnitudes(const BigInteger& a, const BigInteger& b);
  void add_magnitudes(const BigInteger& a, const BigInteger& b);
  void subtract_magnitudes(const BigInteger& larger, const BigInteger& smaller);
  void drop_leading_zeros();

  int sign_ = 0;
  int size_ = 0;
  std::array<std::uint64_t, kWords> words_;  // NOLINT: only the first size_ are ever read
};

// The exponent of the last place of a double of this size: value is a multiple of 2^exponent. It is
// finite and not 0.
[[nodiscard]] int unit_exponent(double value);

}  // namespace meshrepair::internal
