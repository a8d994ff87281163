// SPDX-License-Identifier: MIT
#include "text_scanner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace meshrepair {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

char to_lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Whether a decimal number that is known to lie beyond the range of double is too large, not too
// small: told by the decimal exponent of its first digit that is not 0.
bool is_too_large(std::string_view number) {
  const std::size_t exponent_at = std::min(number.find_first_of("eE"), number.size());
  std::int64_t exponent = 0;
  if (exponent_at < number.size()) {
    const char* first = number.data() + exponent_at + 1;
    if (*first == '+') ++first;
    const auto [end, error] = std::from_chars(first, number.data() + number.size(), exponent);
    if (error == std::errc::result_out_of_range) return *first != '-';
  }
  const std::string_view digits = number.substr(0, exponent_at);
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const std::size_t leading = digits.find_first_of("123456789");
  return exponent + static_cast<std::int64_t>(point) - static_cast<std::int64_t>(leading) > 0;
}

// "1.#INF", "-1.#IND", "1.#QNAN" as Microsoft's C library prints them.
bool is_microsoft_special(std::string_view unsigned_token) {
  return unsigned_token.substr(0, 3) == "1.#";
}

bool parse_plain(std::string_view number, double& value) {
  const char* const last = number.data() + number.size();
  const auto [end, error] = read_decimal(number.data(), last, value);
  if (end != last || number.empty()) return false;
  if (error == std::errc::result_out_of_range) value = is_too_large(number) ? kInfinity : 0.0;
  return error == std::errc() || error == std::errc::result_out_of_range;
}

}  // namespace

bool looks_like_text(std::string_view bytes) {
  constexpr std::size_t kStart = 4096;
  const std::string_view start = bytes.substr(0, kStart);
  return std::none_of(start.begin(), start.end(), [](char c) {
    const bool is_white = c >= '\t' && c <= '\r';
    return static_cast<unsigned char>(c) < ' ' && !is_white && c != '\x1A';
  });
}

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

bool equals_ignoring_case(std::string_view token, std::string_view lower) {
  return std::equal(token.begin(), token.end(), lower.begin(), lower.end(),
                    [](char a, char b) { return to_lower(a) == b; });
}

std::size_t find_ignoring_case(std::string_view text, std::string_view lower) {
  const auto at = std::search(text.begin(), text.end(), lower.begin(), lower.end(),
                              [](char a, char b) { return to_lower(a) == b; });
  return at == text.end() ? std::string_view::npos : static_cast<std::size_t>(at - text.begin());
}

bool parse_odd_real(std::string_view token, double& value) {
  value = kNaN;
  const bool negative = token.starts_with('-');
  if (negative || token.starts_with('+')) token.remove_prefix(1);
  if (token.empty() || token.front() == '-') return false;
  if (is_microsoft_special(token)) {
    const bool infinite = find_ignoring_case(token, "inf") != std::string_view::npos;
    if (infinite) value = negative ? -kInfinity : kInfinity;
    return true;
  }
  // Long enough for any number that a program prints with a comma or the letter D.
  std::array<char, 512> spelled;
  double magnitude = 0;
  if (token.size() <= spelled.size()) {
    std::transform(token.begin(), token.end(), spelled.begin(), [](char c) {
      if (c == ',') return '.';
      return c == 'd' || c == 'D' ? 'e' : c;
    });
    token = std::string_view(spelled.data(), token.size());
  }
  if (!parse_plain(token, magnitude)) return false;
  value = negative ? -magnitude : magnitude;
  return true;
}

bool TextScanner::skip_continuation() {
  if (!dialect_.continuation) return false;
  const char* at = at_ + 1;
  while (at != end_ && is_space(*at) && !is_line_end(*at)) ++at;
  if (at != end_ && !is_line_end(*at)) return false;
  at_ = at;
  skip_line();
  return true;
}

std::string_view TextScanner::rest_of_line() {
  if (!next_on_line()) return {};
  const char* const first = at_;
  const char* end = at_;
  while (next_on_line()) {
    skip_token();
    end = at_;
  }
  return {first, static_cast<std::size_t>(end - first)};
}

std::size_t TextScanner::tokens_on_line() const {
  TextScanner ahead = *this;
  std::size_t count = 0;
  for (; ahead.next_on_line(); ++count) ahead.skip_token();
  return count;
}

bool TextScanner::read_integer(std::int64_t& value, char tail) {
  const char* const first = *at_ == '+' && remaining() > 1 && is_digit(at_[1]) ? at_ + 1 : at_;
  const auto [end, error] = std::from_chars(first, end_, value);
  const bool has_tail = tail != '\0' && end != end_ && *end == tail;
  if (error == std::errc() && (has_tail || ends_token(end))) {
    at_ = end;
    if (has_tail) skip_token();
    return true;
  }
  // Some programs print integers as "3.0" or "3e0".
  constexpr double kLargest = 9007199254740992.0;  // 2^53: doubles count without gaps up to here
  double real = 0;
  if (!read_real(real) || !(std::abs(real) <= kLargest) || real != std::floor(real)) return false;
  value = static_cast<std::int64_t>(real);
  return true;
}

}  // namespace meshrepair
