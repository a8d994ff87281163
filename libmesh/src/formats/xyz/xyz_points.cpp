// SPDX-License-Identifier: MIT
#include "xyz_points.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>

#include <mesh/mesh_limits.h>
#include <mesh/mesh_source.h>
#include <mesh/read_guard.h>

#include "formats/common/point_columns.h"
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

namespace {

// Lines that are looked at before what the columns are is settled.
constexpr std::size_t kLinesLookedAt = 256;

// At most PointLine::kMost numbers; stops at the first token that is none.
PointLine read_line(TextScanner& text) {
  PointLine line;
  while (line.count < PointLine::kMost && text.next_on_line()) {
    double value = 0;
    if (!text.read_real(value)) break;
    line.numbers[line.count++] = value;
  }
  return line;
}

// A comment as # is, but longer.
bool is_slashes(const TextScanner& text) { return text.peek_token().starts_with("//"); }

bool is_count(const PointLine& line) {
  constexpr double kLargest = 0x1p53;
  const double value = line.numbers[0];
  return line.count == 1 && value >= 0 && value < kLargest && value == std::floor(value);
}

// The first lines that hold a point or a count.
std::vector<PointLine> first_lines(std::string_view bytes, std::size_t most) {
  TextScanner text(bytes, {.comment = '#'});
  std::vector<PointLine> lines;
  // A file that is something else has no such lines for long.
  for (std::size_t i = 0; i < 2 * most && lines.size() < most && text.next_anywhere(); ++i) {
    if (!is_slashes(text)) {
      const PointLine line = read_line(text);
      if (line.count >= 3 || (line.count == 1 && is_count(line))) lines.push_back(line);
    }
    text.skip_line();
  }
  return lines;
}

class XyzReader {
 public:
  XyzReader(const MeshSource& source, std::string_view bytes, const PointReadOptions& options)
      : source_(source), text_(bytes, {.comment = '#'}), options_(options), guard_(source) {
    names_ = find_names(bytes);
    std::vector<PointLine> lines = first_lines(bytes.substr(names_.end), kLinesLookedAt);
    std::erase_if(lines, [](const PointLine& line) { return line.count < 3; });
    for (PointLine& line : lines) line = arranged(line, names_);
    columns_ = guess_columns(lines);
    text_.go_to(names_.end);
  }

  PointReadResult run() {
    PointReadReport& report = result_.report;
    report.normals = columns_.normal != 0;
    report.colours = columns_.colour != 0;
    while (text_.next_anywhere()) {
      guard_.step(0, text_.position());
      if (!is_slashes(text_)) take_line();
      text_.skip_line();
    }
    split_normals();
    if (report.declared_points > 0) report.format = PointFormat::pts;
    judge();
    return std::move(result_);
  }

 private:
  void take_line() {
    const std::size_t line_at = text_.position();
    const PointLine line = arranged(read_line(text_), names_);
    PointCloud& cloud = result_.cloud;
    if (is_count(line) && !text_.next_on_line()) {
      result_.report.declared_points += static_cast<std::uint64_t>(line.numbers[0]);
    } else if (line.count < 3) {
      if (result_.report.bad_points++ == 0) first_bad_ = line_at;
    } else {
      cloud.points.push_back(line.triple(0));
      if (columns_.normal != 0 && options_.normals)
        cloud.normals.push_back(line.triple(columns_.normal));
      if (columns_.colour != 0 && options_.colours) cloud.colours.push_back(colour_of(line));
    }
  }

  [[nodiscard]] std::array<std::uint8_t, 3> colour_of(const PointLine& line) const {
    std::array<std::uint8_t, 3> colour = {};
    for (std::size_t k = 0; k < 3; ++k) colour[k] = to_colour(line.numbers[columns_.colour + k]);
    return colour;
  }

  // PWN: the points, as many as were promised, and then, in as many lines, their normals, of length
  // 1. Where the count is a little wrong, half of the lines are points; where normals are missing,
  // there are none.
  void split_normals() {
    auto& points = result_.cloud.points;
    const std::size_t all = points.size();
    const std::size_t promised = within(result_.report.declared_points, kMostPoints);
    if (promised == 0 || promised == all || columns_.normal != 0) return;
    const std::size_t half = all / 2;
    const std::size_t wrong = std::max(half, promised) - std::min(half, promised);
    if (all % 2 == 0 && wrong <= half / 20 && are_of_length_one(half)) {
      take_normals(half);
    } else if (all > promised && all < 2 * promised && are_of_length_one(promised)) {
      result_.report.warnings.push_back({WarningCode::attributes_unreadable,
                                         "of " + counted(promised, "point") + " the normals of " +
                                             std::to_string(all - promised) +
                                             " are there: none are taken",
                                         {{"promised", promised}, {"found", all - promised}}});
      points.resize(promised);
    }
  }

  // Nearly all from this one on.
  [[nodiscard]] bool are_of_length_one(std::size_t first) const {
    constexpr double kNearOne = 0.05;
    const auto& points = result_.cloud.points;
    const auto count = static_cast<std::size_t>(
        std::count_if(points.begin() + static_cast<std::ptrdiff_t>(first), points.end(),
                      [](const Vec3d& v) { return std::abs(v.norm() - 1) < kNearOne; }));
    const std::size_t looked_at = points.size() - first;
    return looked_at > 0 && count >= looked_at - looked_at / 5;
  }

  void take_normals(std::size_t half) {
    auto& points = result_.cloud.points;
    result_.report.normals = true;
    if (options_.normals) {
      result_.cloud.normals.assign(points.begin() + static_cast<std::ptrdiff_t>(half),
                                   points.end());
    }
    points.resize(half);
  }

  void judge() {
    PointReadReport& report = result_.report;
    const std::size_t good = result_.cloud.points.size();
    if (report.bad_points > good) {
      source_.fail_at(first_bad_, "is no list of points: " + counted(report.bad_points, "line") +
                                      " without three numbers, " + std::to_string(good) + " with");
    }
    if (report.bad_points > 0) {
      report.warnings.push_back({WarningCode::points_unreadable,
                                 counted(report.bad_points, "line") +
                                     " without three numbers left out (first: line " +
                                     std::to_string(source_.line_at(first_bad_)) + ")",
                                 {{"points", report.bad_points}}});
    }
    if (report.declared_points > good) report.missing_points = report.declared_points - good;
    if (report.declared_points > 0 && report.declared_points != good) {
      report.warnings.push_back(cut_off("the file", report.declared_points, "point", good));
    }
  }

  const MeshSource& source_;
  TextScanner text_;
  const PointReadOptions& options_;
  ReadGuard guard_;
  ColumnNames names_;
  PointColumns columns_;
  PointReadResult result_;
  std::size_t first_bad_ = 0;
};

}  // namespace

bool begins_with_points(std::string_view bytes) {
  if (!looks_like_text(bytes)) return false;
  constexpr std::size_t kFar = 65536;  // a long comment may come first
  const std::string_view start = bytes.substr(0, kFar);
  const std::vector<PointLine> lines = first_lines(with_blanks(start, find_separators(start)), 2);
  if (lines.empty()) return false;
  return lines[0].count >= 3 || (lines.size() == 2 && lines[1].count >= 3);
}

bool has_point_extension(const std::string& name) {
  const std::string extension = without_packing(name).extension().string();
  return std::any_of(kPointExtensions.begin(), kPointExtensions.end(), [&](std::string_view known) {
    return equals_ignoring_case(extension, known);
  });
}

PointReadResult read_xyz_points(const MeshSource& source, const PointReadOptions& options) {
  const Separators separators = find_separators(source.bytes);
  if (separators == Separators::blanks) return XyzReader(source, source.bytes, options).run();
  const std::string text = with_blanks(source.bytes, separators);
  return XyzReader(source, text, options).run();
}

}  // namespace meshrepair
