// SPDX-License-Identifier: MIT
// Signed integers of 128 bits and more, as far as the exact predicates need them.
//
// Int128 is the compiler's own. WideInt is two's complement in 64-bit words, lowest first; all its
// operations are exact as long as the true result fits, which the callers prove (see predicates.cpp
// and turn.cpp).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace meshrepair {

__extension__ using Int128 = __int128;
__extension__ using Uint128 = unsigned __int128;

[[nodiscard]] constexpr int sign_of(Int128 value) { return (value > 0) - (value < 0); }

template <std::size_t Words>
class WideInt {
  static_assert(Words >= 4);

 public:
  constexpr WideInt() = default;
  constexpr explicit WideInt(Int128 value) {
    words_.fill(value < 0 ? ~std::uint64_t{0} : 0);
    words_[0] = static_cast<std::uint64_t>(value);
    words_[1] = static_cast<std::uint64_t>(value >> 64);
  }

  // The full product of two 128-bit integers.
  [[nodiscard]] static constexpr WideInt product(Int128 a, Int128 b) {
    const bool negative = (a < 0) != (b < 0);
    const Uint128 x = magnitude(a);
    const Uint128 y = magnitude(b);
    const auto x0 = static_cast<std::uint64_t>(x), x1 = static_cast<std::uint64_t>(x >> 64);
    const auto y0 = static_cast<std::uint64_t>(y), y1 = static_cast<std::uint64_t>(y >> 64);
    const Uint128 low = Uint128{x0} * y0;
    const Uint128 mid_a = Uint128{x0} * y1;
    const Uint128 mid_b = Uint128{x1} * y0;
    const Uint128 high = Uint128{x1} * y1;
    WideInt r;
    r.words_[0] = static_cast<std::uint64_t>(low);
    Uint128 sum =
        (low >> 64) + static_cast<std::uint64_t>(mid_a) + static_cast<std::uint64_t>(mid_b);
    r.words_[1] = static_cast<std::uint64_t>(sum);
    sum = (sum >> 64) + (mid_a >> 64) + (mid_b >> 64) + static_cast<std::uint64_t>(high);
    r.words_[2] = static_cast<std::uint64_t>(sum);
    r.words_[3] = static_cast<std::uint64_t>((sum >> 64) + (high >> 64));
    return negative ? -r : r;
  }

  // The full product of two wide integers.
  template <std::size_t OtherWords>
  [[nodiscard]] constexpr WideInt<Words + OtherWords> operator*(
      const WideInt<OtherWords>& other) const {
    const WideInt x = sign() < 0 ? -*this : *this;
    const WideInt<OtherWords> y = other.sign() < 0 ? -other : other;
    WideInt<Words + OtherWords> r;
    for (std::size_t i = 0; i < Words; ++i) {
      Uint128 carry = 0;
      for (std::size_t j = 0; j < OtherWords; ++j) {
        carry += Uint128{x.words_[i]} * y.words_[j] + r.words_[i + j];
        r.words_[i + j] = static_cast<std::uint64_t>(carry);
        carry >>= 64;
      }
      r.words_[i + OtherWords] = static_cast<std::uint64_t>(carry);
    }
    return (sign() < 0) != (other.sign() < 0) ? -r : r;
  }

  // The product with a 64-bit integer, modulo 2^(64 Words).
  [[nodiscard]] constexpr WideInt times(std::int64_t factor) const {
    const bool negative = (sign() < 0) != (factor < 0);
    const WideInt x = sign() < 0 ? -*this : *this;
    const std::uint64_t y = static_cast<std::uint64_t>(magnitude(factor));
    WideInt r;
    Uint128 carry = 0;
    for (std::size_t i = 0; i < Words; ++i) {
      carry += Uint128{x.words_[i]} * y;
      r.words_[i] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    return negative ? -r : r;
  }

  constexpr WideInt operator-() const {
    WideInt r;
    Uint128 carry = 1;
    for (std::size_t i = 0; i < Words; ++i) {
      carry += static_cast<std::uint64_t>(~words_[i]);
      r.words_[i] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    return r;
  }

  friend constexpr WideInt operator+(const WideInt& a, const WideInt& b) {
    WideInt r;
    Uint128 carry = 0;
    for (std::size_t i = 0; i < Words; ++i) {
      carry += Uint128{a.words_[i]} + b.words_[i];
      r.words_[i] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    return r;
  }

  friend constexpr WideInt operator-(const WideInt& a, const WideInt& b) { return a + -b; }
  constexpr bool operator==(const WideInt&) const = default;

  [[nodiscard]] constexpr int sign() const {
    if (static_cast<std::int64_t>(words_[Words - 1]) < 0) return -1;
    std::uint64_t any = 0;
    for (const std::uint64_t word : words_) any |= word;
    return any != 0 ? 1 : 0;
  }

  // The nearest double to within one unit in the last place.
  [[nodiscard]] double to_double() const {
    const WideInt x = sign() < 0 ? -*this : *this;
    std::size_t top = Words - 1;
    while (top > 0 && x.words_[top] == 0) --top;
    // Two words hold at least 65 significant bits, or all there are.
    double value = static_cast<double>(x.words_[top]);
    int exponent = 64 * static_cast<int>(top);
    if (top > 0) {
      const Uint128 pair = (Uint128{x.words_[top]} << 64) | x.words_[top - 1];
      value = static_cast<double>(pair);
      exponent -= 64;
    }
    return std::ldexp(sign() < 0 ? -value : value, exponent);
  }

 private:
  template <std::size_t>
  friend class WideInt;

  [[nodiscard]] static constexpr Uint128 magnitude(Int128 v) {
    return v < 0 ? Uint128{0} - static_cast<Uint128>(v) : static_cast<Uint128>(v);
  }

  std::array<std::uint64_t, Words> words_{};
};

using Int256 = WideInt<4>;

}  // namespace meshrepair
