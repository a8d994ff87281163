// SPDX-License-Identifier: MIT
#include "off_header.h"

namespace meshrepair {
namespace {

bool is_dimension_digit(char c) { return c >= '0' && c <= '9'; }

class OffHeaderReader {
 public:
  explicit OffHeaderReader(const MeshSource& source)
      : source_(source), text_(source.bytes, kOffText) {}

  OffHeader run() {
    read_keyword();
    if (header_.binary) return header_;
    if (header_.dimension && read_count("the dimension") != 3) {
      source_.fail_at(text_.position(), "only points with three coordinates can be read");
    }
    header_.points = read_count("the number of points");
    const bool counts_on_one_line = text_.next_on_line();
    header_.faces = read_count("the number of faces");
    // The number of edges, which nobody uses and some leave out.
    if (text_.next_on_line() || !counts_on_one_line) read_count("the number of edges");
    header_.counts_end_line = !text_.next_on_line();
    header_.data_at = text_.position();
    return header_;
  }

 private:
  void read_keyword() {
    if (!text_.next_anywhere()) return;
    const std::size_t length = parse_off_keyword(text_.peek_token(), header_);
    text_.go_to(text_.position() + length);
    if (length == 0 || !text_.next_on_line()) return;
    if (equals_ignoring_case(text_.peek_token(), "binary")) {
      text_.skip_line();
      header_.binary = true;
      header_.data_at = text_.position();
    }
  }

  std::uint64_t read_count(const std::string& what) {
    if (!text_.next_anywhere()) source_.fail("an OFF file that ends before " + what);
    const std::size_t start = text_.position();
    std::int64_t count = 0;
    if (!text_.read_integer(count) || count < 0) {
      source_.fail_at(start, what + " of the OFF file is not a number");
    }
    return static_cast<std::uint64_t>(count);
  }

  const MeshSource& source_;
  TextScanner text_;
  OffHeader header_;
};

}  // namespace

std::size_t parse_off_keyword(std::string_view token, OffHeader& header) {
  std::size_t at = 0;
  OffHeader parsed;
  const auto take = [&](std::string_view prefix) {
    if (!equals_ignoring_case(token.substr(at, prefix.size()), prefix)) return false;
    at += prefix.size();
    return true;
  };
  parsed.texture = take("st");
  parsed.color = take("c");
  const bool lower_n = token.substr(at).starts_with('n');
  // "nOFF" has a dimension, "NOFF" and "noff" have normals.
  parsed.normal = !(lower_n && token.substr(at + 1).starts_with("OFF")) && take("n");
  parsed.homogeneous = take("4");
  parsed.dimension = take("n");
  if (!take("off")) return 0;
  if (at < token.size() && !is_dimension_digit(token[at])) return 0;
  parsed.has_keyword = true;
  header = parsed;
  return at;
}

OffHeader read_off_header(const MeshSource& source) { return OffHeaderReader(source).run(); }

}  // namespace meshrepair
