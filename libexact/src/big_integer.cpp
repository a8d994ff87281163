// SPDX-License-Identifier: MIT
#include "big_integer.h"

#include <algorithm>
#include <cmath>

#include <exact/wide_int.h>

namespace meshrepair::internal {

int unit_exponent(double value) {
  return std::max(std::ilogb(value) - 52, BigInteger::kSmallestExponent);
}

BigInteger::BigInteger(double value, int exponent) {
  if (value == 0) return;
  const int unit = unit_exponent(value);
  const auto mantissa = static_cast<std::uint64_t>(std::ldexp(std::abs(value), -unit));
  const int shift = unit - exponent;
  const int word = shift / 64, bit = shift % 64;
  std::fill(words_.begin(), words_.begin() + word, 0);
  words_[static_cast<std::size_t>(word)] = mantissa << bit;
  words_[static_cast<std::size_t>(word) + 1] = bit == 0 ? 0 : mantissa >> (64 - bit);
  sign_ = value > 0 ? 1 : -1;
  size_ = word + 2;
  drop_leading_zeros();
}

BigInteger& BigInteger::operator=(const BigInteger& other) {
  if (this == &other) return *this;
  sign_ = other.sign_;
  size_ = other.size_;
  std::copy_n(other.words_.begin(), size_, words_.begin());
  return *this;
}

void BigInteger::drop_leading_zeros() {
  while (size_ > 0 && words_[static_cast<std::size_t>(size_) - 1] == 0) --size_;
  if (size_ == 0) sign_ = 0;
}

int BigInteger::compare_magnitudes(const BigInteger& a, const BigInteger& b) {
  if (a.size_ != b.size_) return a.size_ < b.size_ ? -1 : 1;
  for (auto i = static_cast<std::size_t>(a.size_); i-- > 0;) {
    if (a.words_[i] != b.words_[i]) return a.words_[i] < b.words_[i] ? -1 : 1;
  }
  return 0;
}

void BigInteger::add_magnitudes(const BigInteger& a, const BigInteger& b) {
  const auto count = static_cast<std::size_t>(std::max(a.size_, b.size_));
  Uint128 carry = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (i < static_cast<std::size_t>(a.size_)) carry += a.words_[i];
    if (i < static_cast<std::size_t>(b.size_)) carry += b.words_[i];
    words_[i] = static_cast<std::uint64_t>(carry);
    carry >>= 64;
  }
  words_[count] = static_cast<std::uint64_t>(carry);
  size_ = static_cast<int>(count) + 1;
}

void BigInteger::subtract_magnitudes(const BigInteger& larger, const BigInteger& smaller) {
  std::uint64_t borrow = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(larger.size_); ++i) {
    const std::uint64_t taken = i < static_cast<std::size_t>(smaller.size_) ? smaller.words_[i] : 0;
    const std::uint64_t from = larger.words_[i];
    words_[i] = from - taken - borrow;
    borrow = from < taken || (from == taken && borrow != 0) ? 1 : 0;
  }
  size_ = larger.size_;
}

BigInteger operator+(const BigInteger& a, const BigInteger& b) {
  if (a.sign_ == 0) return b;
  if (b.sign_ == 0) return a;
  BigInteger sum;
  if (a.sign_ == b.sign_) {
    sum.add_magnitudes(a, b);
    sum.sign_ = a.sign_;
  } else {
    const bool a_is_larger = BigInteger::compare_magnitudes(a, b) >= 0;
    sum.subtract_magnitudes(a_is_larger ? a : b, a_is_larger ? b : a);
    sum.sign_ = a_is_larger ? a.sign_ : b.sign_;
  }
  sum.drop_leading_zeros();
  return sum;
}

BigInteger operator-(const BigInteger& a, const BigInteger& b) {
  BigInteger negative = b;
  negative.sign_ = -b.sign_;
  return a + negative;
}

BigInteger operator*(const BigInteger& a, const BigInteger& b) {
  BigInteger product;
  if (a.sign_ == 0 || b.sign_ == 0) return product;
  const auto rows = static_cast<std::size_t>(a.size_), columns = static_cast<std::size_t>(b.size_);
  std::fill_n(product.words_.begin(), rows + columns, 0);
  for (std::size_t i = 0; i < rows; ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < columns; ++j) {
      const Uint128 sum = Uint128{a.words_[i]} * b.words_[j] + product.words_[i + j] + carry;
      product.words_[i + j] = static_cast<std::uint64_t>(sum);
      carry = static_cast<std::uint64_t>(sum >> 64);
    }
    product.words_[i + columns] = carry;
  }
  product.size_ = a.size_ + b.size_;
  product.sign_ = a.sign_ * b.sign_;
  product.drop_leading_zeros();
  return product;
}

}  // namespace meshrepair::internal
