// Signed integers of 128 and 256 bits, as far as the exact predicates need them.
//
// Int128 is the compiler's own. Int256 is two's complement in four 64-bit words, lowest first; all
// its operations are exact as long as the true result fits, which the callers prove (see
// predicates.cpp).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace meshrepair {

__extension__ using Int128 = __int128;
__extension__ using Uint128 = unsigned __int128;

[[nodiscard]] constexpr int sign_of(Int128 value) { return (value > 0) - (value < 0); }

class Int256 {
 public:
  constexpr Int256() = default;
  constexpr explicit Int256(Int128 value)
      : words_{static_cast<std::uint64_t>(value), static_cast<std::uint64_t>(value >> 64),
               value < 0 ? ~std::uint64_t{0} : 0, value < 0 ? ~std::uint64_t{0} : 0} {}

  // The full product of two 128-bit integers.
  [[nodiscard]] static constexpr Int256 product(Int128 a, Int128 b) {
    const bool negative = (a < 0) != (b < 0);
    const Uint128 x = magnitude(a);
    const Uint128 y = magnitude(b);
    const auto x0 = static_cast<std::uint64_t>(x), x1 = static_cast<std::uint64_t>(x >> 64);
    const auto y0 = static_cast<std::uint64_t>(y), y1 = static_cast<std::uint64_t>(y >> 64);
    const Uint128 low = Uint128{x0} * y0;
    const Uint128 mid_a = Uint128{x0} * y1;
    const Uint128 mid_b = Uint128{x1} * y0;
    const Uint128 high = Uint128{x1} * y1;
    Int256 r;
    r.words_[0] = static_cast<std::uint64_t>(low);
    Uint128 sum =
        (low >> 64) + static_cast<std::uint64_t>(mid_a) + static_cast<std::uint64_t>(mid_b);
    r.words_[1] = static_cast<std::uint64_t>(sum);
    sum = (sum >> 64) + (mid_a >> 64) + (mid_b >> 64) + static_cast<std::uint64_t>(high);
    r.words_[2] = static_cast<std::uint64_t>(sum);
    r.words_[3] = static_cast<std::uint64_t>((sum >> 64) + (high >> 64));
    return negative ? -r : r;
  }

  // The product with a 64-bit integer, modulo 2^256.
  [[nodiscard]] constexpr Int256 times(std::int64_t factor) const {
    const bool negative = (sign() < 0) != (factor < 0);
    const Int256 x = sign() < 0 ? -*this : *this;
    const std::uint64_t y = static_cast<std::uint64_t>(magnitude(factor));
    Int256 r;
    Uint128 carry = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      carry += Uint128{x.words_[i]} * y;
      r.words_[i] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    return negative ? -r : r;
  }

  constexpr Int256 operator-() const {
    Int256 r;
    Uint128 carry = 1;
    for (std::size_t i = 0; i < 4; ++i) {
      carry += static_cast<std::uint64_t>(~words_[i]);
      r.words_[i] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    return r;
  }

  friend constexpr Int256 operator+(const Int256& a, const Int256& b) {
    Int256 r;
    Uint128 carry = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      carry += Uint128{a.words_[i]} + b.words_[i];
      r.words_[i] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    return r;
  }

  friend constexpr Int256 operator-(const Int256& a, const Int256& b) { return a + -b; }
  constexpr bool operator==(const Int256&) const = default;

  [[nodiscard]] constexpr int sign() const {
    if (static_cast<std::int64_t>(words_[3]) < 0) return -1;
    return (words_[0] | words_[1] | words_[2] | words_[3]) != 0 ? 1 : 0;
  }

  // The nearest double to within one unit in the last place.
  [[nodiscard]] double to_double() const {
    const Int256 x = sign() < 0 ? -*this : *this;
    std::size_t top = 3;
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
  [[nodiscard]] static constexpr Uint128 magnitude(Int128 v) {
    return v < 0 ? Uint128{0} - static_cast<Uint128>(v) : static_cast<Uint128>(v);
  }

  std::array<std::uint64_t, 4> words_{};
};

}  // namespace meshrepair
