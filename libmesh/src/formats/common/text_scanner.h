// SPDX-License-Identifier: MIT
// Walks over the tokens of a text file: fast, independent of the locale, without allocation.
//
// A token is a run of bytes above the blank. LF, CRLF and CR end lines; every other byte up to the
// blank is a blank. The scanner stands between tokens or at the start of one; the functions named
// next_* go to the start of a token, those named read_* and skip_token need to stand there and
// leave it whole.
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <system_error>

#include <base/decimal.h>

namespace meshrepair {

// No byte that text does not have, near the start.
[[nodiscard]] bool looks_like_text(std::string_view bytes);

// Without the blanks and line ends around it.
[[nodiscard]] std::string_view without_blanks(std::string_view text);

struct TextDialect {
  char comment = '\0';        // a token that begins with it ends the line; 0: there are no comments
  bool continuation = false;  // a backslash at the end of a line joins it to the next
};

// Case is ignored for the letters of ASCII; `lower` is in lower case.
[[nodiscard]] bool equals_ignoring_case(std::string_view token, std::string_view lower);

// Position of the first occurrence, case ignored; npos if there is none.
[[nodiscard]] std::size_t find_ignoring_case(std::string_view text, std::string_view lower);

// The spellings that std::from_chars does not take: a leading '+', a decimal comma, the exponent
// letter D, "1.#IND", "-1.#INF", numbers beyond the range of double (they become inf or 0). False,
// and NaN, if the token is no number.
[[nodiscard]] bool parse_odd_real(std::string_view token, double& value);

class TextScanner {
 public:
  explicit TextScanner(std::string_view text, TextDialect dialect = {})
      : begin_(text.data()), at_(begin_), end_(begin_ + text.size()), dialect_(dialect) {}

  [[nodiscard]] std::size_t position() const { return static_cast<std::size_t>(at_ - begin_); }
  [[nodiscard]] std::size_t remaining() const { return static_cast<std::size_t>(end_ - at_); }
  void go_to(std::size_t position) { at_ = begin_ + position; }

  // Goes to the next token of this line, or of the text. False when there is none; the scanner is
  // then at the end of the line (before its line end), or of the text.
  bool next_on_line();
  bool next_anywhere();

  // Goes behind the next line end.
  void skip_line();
  void skip_token();

  // The byte at the start of the token, and the token.
  [[nodiscard]] char peek() const { return *at_; }
  [[nodiscard]] std::string_view peek_token() const;

  // What is left of the line, without the blanks around it; goes to its end.
  std::string_view rest_of_line();

  // Number of tokens from here to the end of the line.
  [[nodiscard]] std::size_t tokens_on_line() const;

  // Reads a number. False when the token is none; the value is then NaN.
  bool read_real(double& value);
  // Reads an integer. The token may go on with `tail`, which is passed over with what follows.
  // False when the token is none, or too large.
  bool read_integer(std::int64_t& value, char tail = '\0');

 private:
  static bool is_line_end(char c) { return c == '\n' || c == '\r'; }
  static bool is_space(char c) { return static_cast<unsigned char>(c) <= ' '; }

  // Whether a token ends before this byte: at a blank, and at a backslash that continues the line.
  [[nodiscard]] bool ends_token(const char* at) const {
    if (at == end_ || is_space(*at)) return true;
    return dialect_.continuation && *at == '\\' && (at + 1 == end_ || is_line_end(at[1]));
  }

  // At a backslash that continues the line: goes behind the line end.
  bool skip_continuation();
  const char* token_end() const;

  const char* begin_;
  const char* at_;
  const char* end_;
  TextDialect dialect_;
};

inline const char* TextScanner::token_end() const {
  const char* end = at_;
  while (!ends_token(end)) ++end;
  return end;
}

inline void TextScanner::skip_token() { at_ = token_end(); }

inline std::string_view TextScanner::peek_token() const {
  return {at_, static_cast<std::size_t>(token_end() - at_)};
}

inline bool TextScanner::next_on_line() {
  for (;;) {
    while (at_ != end_ && is_space(*at_) && !is_line_end(*at_)) ++at_;
    if (at_ == end_ || is_line_end(*at_)) return false;
    if (dialect_.comment != '\0' && *at_ == dialect_.comment) {
      while (at_ != end_ && !is_line_end(*at_)) ++at_;
      return false;
    }
    if (*at_ != '\\' || !skip_continuation()) return true;
  }
}

inline bool TextScanner::next_anywhere() {
  while (!next_on_line()) {
    if (at_ == end_) return false;
    ++at_;
  }
  return true;
}

inline void TextScanner::skip_line() {
  while (at_ != end_ && !is_line_end(*at_)) ++at_;
  if (at_ == end_) return;
  const bool crlf = *at_ == '\r' && at_ + 1 != end_ && at_[1] == '\n';
  at_ += crlf ? 2 : 1;
}

inline bool TextScanner::read_real(double& value) {
  const auto [end, error] = read_decimal(at_, end_, value);
  if (error == std::errc() && ends_token(end)) {
    at_ = end;
    return true;
  }
  const std::string_view token = peek_token();
  at_ += token.size();
  return parse_odd_real(token, value);
}

}  // namespace meshrepair
