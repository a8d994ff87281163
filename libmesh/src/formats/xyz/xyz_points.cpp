#include "xyz_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>

#include <mesh/mesh_limits.h>
#include <mesh/mesh_source.h>
#include <mesh/read_guard.h>

#include "formats/common/point_columns.h"
#include "formats/common/text_scanner.h"
#include "point_table.h"

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
      result_.report.warnings.push_back("of " + counted(promised, "point") + " the normals of " +
                                        std::to_string(all - promised) +
                                        " are there: none are taken");
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
      report.warnings.push_back(counted(report.bad_points, "line") +
                                " without three numbers left out (first: line " +
                                std::to_string(source_.line_at(first_bad_)) + ")");
    }
    if (report.declared_points > good) report.missing_points = report.declared_points - good;
    if (report.declared_points > 0 && report.declared_points != good) {
      report.warnings.push_back("the file promises " + counted(report.declared_points, "point") +
                                " and holds " + std::to_string(good));
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
