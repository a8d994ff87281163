// SPDX-License-Identifier: MIT
// Reads a run of lines of one kind on several threads.
//
// Readers of text take what nobody would write on purpose: comments anywhere, lines cut short,
// numbers in odd spellings. Nearly all lines are plain, and what a plain line says does not depend
// on those before it. So plain lines are read in pieces of the text, and the first line that is
// not plain, with all behind it, is left to the reader, which knows what to make of it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>
#include <system_error>
#include <vector>

#include <base/decimal.h>
#include <base/parallel.h>

namespace meshrepair {

// Walks along a line. Each step tells whether it found what it is for; where it did not, the line
// is not plain.
class PlainLine {
 public:
  PlainLine(const char* at, const char* end) : at_(at), end_(end) {}

  [[nodiscard]] const char* at() const { return at_; }

  bool letter(char c) {
    if (at_ == end_ || *at_ != c) return false;
    ++at_;
    return true;
  }
  bool blanks() {
    const char* const first = at_;
    skip_blanks();
    return at_ != first;
  }
  template <class Number>
  bool number(Number& value) {
    const auto [behind, error] = read_decimal(at_, end_, value);
    at_ = behind;
    return error == std::errc();
  }
  // The rest of a token. One with a backslash may go on in the next line.
  bool token() {
    for (; at_ != end_ && static_cast<unsigned char>(*at_) > ' '; ++at_) {
      if (*at_ == '\\') return false;
    }
    return true;
  }
  // Goes behind the line end.
  bool ends() {
    skip_blanks();
    if (at_ != end_ && *at_ == '\r') ++at_;
    return letter('\n');
  }

 private:
  void skip_blanks() {
    while (at_ != end_ && (*at_ == ' ' || *at_ == '\t')) ++at_;
  }

  const char* at_;
  const char* end_;
};

namespace internal {

constexpr std::size_t kFirstPlainPiece = 4096, kPlainPiece = 32768, kMostPlainPieces = 32;

// Some whole lines. They are plain up to `stop`.
struct PlainPiece {
  std::size_t begin, end;
  std::size_t stop;
};

// The next pieces of `size` bytes in all, a little more for whole lines.
inline std::vector<PlainPiece> plain_pieces(std::string_view text, std::size_t begin,
                                            std::size_t size) {
  std::vector<PlainPiece> pieces;
  const std::size_t stop = std::min(text.size(), begin + size);
  while (begin < stop) {
    std::size_t last = text.find('\n', begin + std::min(size, kPlainPiece) - 1);
    if (last == std::string_view::npos) last = text.rfind('\n');
    if (last == std::string_view::npos || last < begin) break;
    pieces.push_back({begin, last + 1, begin});
    begin = last + 1;
  }
  return pieces;
}

// What the plain lines of a piece say.
template <class Item, class Parse>
void read_piece(std::string_view text, PlainPiece& piece, std::vector<Item>& items,
                const Parse& parse) {
  items.clear();
  Item item;
  while (piece.stop < piece.end) {
    PlainLine line(text.data() + piece.stop, text.data() + piece.end);
    if (!parse(line, item)) return;
    items.push_back(item);
    piece.stop = static_cast<std::size_t>(line.at() - text.data());
  }
}

}  // namespace internal

// Reads lines from `position` on, the start of a line or of its first token, as long as
// parse(line, item) says that they are plain; they are then read to their end. take(items,
// position) gets what they say, in their order, with the position behind them, and returns how many
// of them it takes; not all, and none is read any more. Returns the position behind the last one
// that was taken.
//
// The first portion is small, as the run may be short.
template <class Item, class Parse, class Take>
std::size_t read_plain_lines(std::string_view text, std::size_t position, const Parse& parse,
                             const Take& take) {
  constexpr std::size_t kMost = internal::kMostPlainPieces * internal::kPlainPiece;
  std::vector<std::vector<Item>> items(internal::kMostPlainPieces);
  for (std::size_t size = internal::kFirstPlainPiece;; size = std::min(2 * size, kMost)) {
    std::vector<internal::PlainPiece> pieces = internal::plain_pieces(text, position, size);
    if (pieces.empty()) return position;
    parallel_for(pieces.size(),
                 [&](std::size_t i) { internal::read_piece(text, pieces[i], items[i], parse); });
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const std::size_t taken = take(std::span<const Item>(items[i]), pieces[i].stop);
      if (taken < items[i].size()) {
        position = pieces[i].begin;
        for (std::size_t k = 0; k < taken; ++k) position = text.find('\n', position) + 1;
        return position;
      }
      position = pieces[i].stop;
      if (position < pieces[i].end) return position;
    }
  }
}

}  // namespace meshrepair
