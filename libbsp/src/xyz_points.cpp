#include "xyz_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>

#include "point_columns.h"
#include "read_guard.h"
#include "recognize_format.h"
#include "text_scanner.h"

namespace meshrepair {
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

// Commas and semicolons between numbers, unless the commas are decimal ones.
bool has_separators(std::string_view bytes) {
  TextScanner text(bytes, {.comment = '#'});
  for (int lines = 0; lines < 3 && text.next_anywhere(); ++lines) {
    const std::string_view token = text.peek_token();
    const auto count =
        std::count_if(token.begin(), token.end(), [](char c) { return c == ',' || c == ';'; });
    if (count >= 2 || token.ends_with(',') || token.ends_with(';')) return true;
    text.skip_line();
  }
  return false;
}

std::string without_separators(std::string_view bytes) {
  std::string text(bytes);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
  return text;
}

class XyzReader {
 public:
  XyzReader(const MeshSource& source, std::string_view bytes, const PointReadOptions& options)
      : source_(source), text_(bytes, {.comment = '#'}), options_(options), guard_(source) {
    std::vector<PointLine> lines = first_lines(bytes, kLinesLookedAt);
    std::erase_if(lines, [](const PointLine& line) { return line.count < 3; });
    columns_ = guess_columns(lines);
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
    const PointLine line = read_line(text_);
    PointCloud& cloud = result_.cloud;
    if (is_count(line) && !text_.next_on_line()) {
      result_.report.declared_points += static_cast<std::size_t>(line.numbers[0]);
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

  // PWN: twice as many lines as were promised, the second half of length 1.
  void split_normals() {
    auto& points = result_.cloud.points;
    const std::size_t half = points.size() / 2;
    if (half == 0 || columns_.normal != 0 || result_.report.declared_points != half ||
        points.size() % 2 != 0) {
      return;
    }
    constexpr double kNearOne = 0.05;
    const auto near_one = static_cast<std::size_t>(
        std::count_if(points.begin() + static_cast<std::ptrdiff_t>(half), points.end(),
                      [](const Vec3d& v) { return std::abs(v.norm() - 1) < kNearOne; }));
    if (near_one < half - half / 5) return;
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
      report.warnings.push_back(counted(report.bad_points, "line") +
                                " without three numbers left out (first: line " +
                                std::to_string(source_.line_at(first_bad_)) + ")");
    }
    if (report.declared_points > good) {
      report.missing_points = report.declared_points - good;
      report.warnings.push_back("the file promises " + counted(report.declared_points, "point") +
                                " and holds " + std::to_string(good));
    }
  }

  const MeshSource& source_;
  TextScanner text_;
  const PointReadOptions& options_;
  ReadGuard guard_;
  PointColumns columns_;
  PointReadResult result_;
  std::size_t first_bad_ = 0;
};

}  // namespace

bool begins_with_points(std::string_view bytes) {
  if (!looks_like_text(bytes)) return false;
  constexpr std::size_t kFar = 65536;  // a long comment may come first
  const std::string_view start = bytes.substr(0, kFar);
  const std::vector<PointLine> lines =
      has_separators(start) ? first_lines(without_separators(start), 2) : first_lines(start, 2);
  if (lines.empty()) return false;
  return lines[0].count >= 3 || (lines.size() == 2 && lines[1].count >= 3);
}

bool has_point_extension(const std::string& name) {
  constexpr std::array<std::string_view, 9> kExtensions = {
      ".xyz", ".xyzn", ".xyzrgb", ".pts", ".pwn", ".txt", ".asc", ".csv", ".pnt"};
  const std::string extension = std::filesystem::path(name).extension().string();
  return std::any_of(kExtensions.begin(), kExtensions.end(), [&](std::string_view known) {
    return equals_ignoring_case(extension, known);
  });
}

PointReadResult read_xyz_points(const MeshSource& source, const PointReadOptions& options) {
  if (!has_separators(source.bytes)) return XyzReader(source, source.bytes, options).run();
  const std::string text = without_separators(source.bytes);
  return XyzReader(source, text, options).run();
}

}  // namespace meshrepair
