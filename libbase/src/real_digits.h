// SPDX-License-Identifier: MIT
// What decimal.h needs where the standard library lacks it, by fast_float and fmt. In a header, so
// that a test holds it against a standard library that has it.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fast_float/fast_float.h>
#include <fmt/format.h>
#include <string_view>
#include <system_error>

namespace meshrepair::internal {

// Beyond the range of double: the value stays as it was.
inline std::from_chars_result read_real_digits(const char* first, const char* last, double& value) {
  double read = 0;
  const auto [end, error] = fast_float::from_chars(first, last, read);
  if (error != std::errc()) return {end, error};
  const auto has_any = [first, end = end](std::string_view digits) {
    const std::string_view text(first, static_cast<std::size_t>(end - first));
    const std::string_view mantissa = text.substr(0, text.find_first_of("eE"));
    return mantissa.find_first_of(digits) != std::string_view::npos;
  };
  const bool is_too_large = std::isinf(read) && has_any("0123456789");
  const bool is_too_small = read == 0 && has_any("123456789");
  if (is_too_large || is_too_small) return {end, std::errc::result_out_of_range};
  value = read;
  return {end, std::errc()};
}

// The fewest digits that tell the number from others of its type: digits * 10^exponent.
struct ShortestDigits {
  std::array<char, 20> digits{};
  int count = 0;
  int exponent = 0;

  template <class Real>
  explicit ShortestDigits(Real magnitude) {
    std::array<char, 40> text;
    const char* const end = fmt::format_to(text.data(), "{}", magnitude);
    const std::string_view all(text.data(), static_cast<std::size_t>(end - text.data()));
    const std::size_t e = std::min(all.find('e'), all.size());
    const std::string_view mantissa = all.substr(0, e);
    if (e < all.size()) {
      const char* const from = all.data() + e + (all[e + 1] == '+' ? 2 : 1);
      std::from_chars(from, end, exponent);
    }
    bool behind_point = false;
    for (const char c : mantissa) {
      if (c == '.') {
        behind_point = true;
      } else {
        if (behind_point) --exponent;
        if (count > 0 || c != '0') digits[static_cast<std::size_t>(count++)] = c;
      }
    }
    while (count > 1 && digits[static_cast<std::size_t>(count) - 1] == '0') --count, ++exponent;
  }
  [[nodiscard]] std::string_view text() const {
    return {digits.data(), static_cast<std::size_t>(count)};
  }
};

// Appends within a buffer; what does not fit is counted, too.
class Room {
 public:
  Room(char* first, char* last) : at_(first), last_(last) {}
  void add(std::string_view text) {
    const std::size_t fits = std::min(text.size(), static_cast<std::size_t>(last_ - at_));
    at_ = std::copy_n(text.data(), fits, at_);
    overflowed_ |= fits < text.size();
  }
  void add_zeros(int count) {
    for (int i = 0; i < count; ++i) add("0");
  }
  [[nodiscard]] std::to_chars_result result() const {
    if (overflowed_) return {last_, std::errc::value_too_large};
    return {at_, std::errc()};
  }

 private:
  char* at_;
  char* last_;
  bool overflowed_ = false;
};

// All digits of a whole number below 10^23.
inline void add_whole(double magnitude, Room& room) {
  auto rest = static_cast<unsigned __int128>(magnitude);
  std::array<char, 40> text;
  std::size_t at = text.size();
  do {
    text[--at] = static_cast<char>('0' + static_cast<int>(rest % 10));
    rest /= 10;
  } while (rest != 0);
  room.add({text.data() + at, text.size() - at});
}

inline void add_fixed(const ShortestDigits& shortest, double magnitude, Room& room) {
  const int before_point = shortest.count + shortest.exponent;
  if (shortest.exponent >= 0) return add_whole(magnitude, room);
  if (before_point <= 0) {
    room.add("0.");
    room.add_zeros(-before_point);
    return room.add(shortest.text());
  }
  room.add(shortest.text().substr(0, static_cast<std::size_t>(before_point)));
  room.add(".");
  room.add(shortest.text().substr(static_cast<std::size_t>(before_point)));
}

inline void add_scientific(const ShortestDigits& shortest, Room& room) {
  room.add(shortest.text().substr(0, 1));
  if (shortest.count > 1) room.add(".");
  room.add(shortest.text().substr(1));
  const int exponent = shortest.exponent + shortest.count - 1;
  room.add(exponent < 0 ? "e-" : "e+");
  std::array<char, 8> text;
  const char* const end = fmt::format_to(text.data(), "{:02}", std::abs(exponent));
  room.add({text.data(), static_cast<std::size_t>(end - text.data())});
}

// Fixed or scientific, whichever is shorter, and fixed where they are as long.
template <class Real>
std::to_chars_result write_real_digits(char* first, char* last, Real value) {
  Room room(first, last);
  if (std::signbit(value)) room.add("-");
  if (std::isnan(value)) {
    room.add("nan");
  } else if (std::isinf(value)) {
    room.add("inf");
  } else if (value == 0) {
    room.add("0");
  } else {
    const ShortestDigits shortest(std::abs(value));
    const int point = shortest.count == 1 ? 0 : 1;  // in scientific notation
    const bool is_fixed =
        shortest.exponent >= -(shortest.count + 2 + point) && shortest.exponent <= 4 + point;
    if (is_fixed) {
      add_fixed(shortest, static_cast<double>(std::abs(value)), room);
    } else {
      add_scientific(shortest, room);
    }
  }
  return room.result();
}

}  // namespace meshrepair::internal
