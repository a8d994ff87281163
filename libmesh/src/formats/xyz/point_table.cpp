#include "point_table.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "formats/common/text_scanner.h"

namespace meshrepair {
namespace {

constexpr int kLinesWithSeparators = 3;

// "// X", "X", "x:" and the like are x.
std::string_view bare_name(std::string_view token) {
  constexpr std::string_view kAround = "/\"'#:()[]";
  const std::size_t first = token.find_first_not_of(kAround);
  if (first == std::string_view::npos) return {};
  return token.substr(first, token.find_last_not_of(kAround) - first + 1);
}

bool is_number_like(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '+' || c == '.';
}

std::string_view line_at(std::string_view bytes, std::size_t at) {
  return bytes.substr(at, bytes.find_first_of("\r\n", at) - at);
}

// Of the first line that is neither a comment nor a count.
std::size_t columns_below(std::string_view text) {
  TextScanner scanner(text, {.comment = '#'});
  while (scanner.next_anywhere()) {
    const std::size_t columns = scanner.tokens_on_line();
    if (columns > 1 && !scanner.peek_token().starts_with("//")) return columns;
    scanner.skip_line();
  }
  return 0;
}

}  // namespace

Separators find_separators(std::string_view bytes) {
  TextScanner text(bytes, {.comment = '#'});
  bool separated = false, semicolons = false, commas = false, points = false;
  for (int lines = 0; lines < kLinesWithSeparators && text.next_anywhere(); ++lines) {
    const std::string_view token = text.peek_token();
    const auto count =
        std::count_if(token.begin(), token.end(), [](char c) { return c == ',' || c == ';'; });
    separated |= count >= 2 || token.ends_with(',') || token.ends_with(';');
    const std::string_view line = line_at(bytes, text.position());
    semicolons |= line.find(';') != std::string_view::npos;
    if (is_number_like(token.front())) {
      commas |= line.find(',') != std::string_view::npos;
      points |= line.find('.') != std::string_view::npos;
    }
    text.skip_line();
  }
  if (!separated) return Separators::blanks;
  return semicolons && commas && !points ? Separators::semicolons : Separators::commas;
}

std::string with_blanks(std::string_view bytes, Separators separators) {
  std::string text(bytes);
  std::replace_if(
      text.begin(), text.end(),
      [&](char c) { return c == ';' || (c == ',' && separators == Separators::commas); }, ' ');
  return text;
}

ColumnNames find_names(std::string_view text) {
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  if (start == std::string_view::npos || is_number_like(text[start])) return {};
  const std::string_view line = line_at(text, start);
  ColumnNames names;
  std::array<bool, 3> found = {};
  std::size_t column = 0;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t from = line.find_first_not_of(" \t", at);
    if (from == std::string_view::npos) break;
    at = std::min(line.find_first_of(" \t", from), line.size());
    const std::string_view name = bare_name(line.substr(from, at - from));
    if (name.empty()) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (found[axis] || !equals_ignoring_case(name, std::string_view("xyz").substr(axis, 1))) {
        continue;
      }
      found[axis] = true;
      names.coordinates[axis] = column;
    }
    ++column;
  }
  names.end = start + line.size();
  const bool complete = found[0] && found[1] && found[2];
  return complete && columns_below(text.substr(names.end)) == column ? names : ColumnNames{};
}

PointLine arranged(const PointLine& line, const ColumnNames& names) {
  const bool in_order = names.coordinates == std::array<std::size_t, 3>{0, 1, 2};
  if (in_order || line.count < 3) return line;
  PointLine result;
  for (const std::size_t column : names.coordinates) {
    if (column >= line.count) return result;  // no point
  }
  for (const std::size_t column : names.coordinates) {
    result.numbers[result.count++] = line.numbers[column];
  }
  for (std::size_t column = 0; column < line.count; ++column) {
    const auto& taken = names.coordinates;
    if (std::find(taken.begin(), taken.end(), column) == taken.end()) {
      result.numbers[result.count++] = line.numbers[column];
    }
  }
  return result;
}

}  // namespace meshrepair
