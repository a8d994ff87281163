// SPDX-License-Identifier: MIT
// OFF:
//
//   [ST][C][N][4][n]OFF [BINARY]
//   [dimension]
//   points faces edges
//   x y z [w] [normal] [colour] [texture]     for each point
//   n i1 ... in [colour]                      for each face, indices from 0
//
// `#` begins a comment. The format is free of lines by its definition, but what follows the
// coordinates and the indices can be told only by the line: colours come without a C in the
// keyword, and a C without colours. So a point, or a face, is a line, and what is left of the line
// is ignored; only in a file in which the lines mean nothing (all on one line, or one number on
// each) are the tokens counted.
#include "off_io.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include <mesh/edge_table.h>
#include <mesh/read_guard.h>

#include "formats/common/face_list.h"
#include "formats/common/plain_lines.h"
#include "formats/common/text_writer.h"
#include "off_header.h"

namespace meshrepair {
namespace {

// More numbers than any point has: four coordinates, normal, colour, texture.
constexpr std::size_t kMostNumbersPerPoint = 13;

class OffReader {
 public:
  explicit OffReader(const MeshSource& source)
      : source_(source),
        header_(read_off_header(source)),
        text_(source.bytes, kOffText),
        guard_(source) {}

  ReadResult run() {
    result_.report.format = SoupFormat::off;
    result_.report.declared_triangles = header_.faces;
    text_.go_to(header_.data_at);
    lines_count_ = header_.counts_end_line && lines_hold_points();
    // A point takes at least six bytes, "0 0 0" and a blank.
    result_.soup.points.reserve(within(header_.points, text_.remaining() / 6 + 1));
    if (lines_count_ && !header_.homogeneous) read_plain_points();
    while (result_.soup.points.size() < header_.points && text_.next_anywhere()) {
      guard_.step(0, text_.position());
      read_point();
    }
    if (lines_count_ && result_.soup.points.size() == header_.points) read_plain_faces();
    read_faces();
    guard_.step(faces_.triangles(), source_.bytes.size());
    report_losses();
    faces_.append_to(result_, source_.options.progress);
    return std::move(result_);
  }

 private:
  bool lines_hold_points() {
    text_.next_anywhere();
    const std::size_t tokens = text_.tokens_on_line();
    return tokens >= 3 && tokens <= kMostNumbersPerPoint;
  }

  bool next_number() { return lines_count_ ? text_.next_on_line() : text_.next_anywhere(); }

  void read_plain_points() {
    const auto parse = [](PlainLine& line, Vec3d& p) {
      return line.number(p[0]) && line.blanks() && line.number(p[1]) && line.blanks() &&
             line.number(p[2]) && line.ends();
    };
    const auto take = [&](std::span<const Vec3d> read, std::size_t position) {
      std::vector<Vec3d>& points = result_.soup.points;
      const auto count = static_cast<std::size_t>(
          std::min<std::uint64_t>(read.size(), header_.points - points.size()));
      for (const Vec3d& p : read.first(count)) {
        guard_.step(0, position);
        points.push_back(p);
      }
      return count;
    };
    text_.go_to(read_plain_lines<Vec3d>(source_.bytes, text_.position(), parse, take));
  }

  void read_plain_faces() {
    const auto parse = [](PlainLine& line, IndexTriangle& t) {
      return line.letter('3') && line.blanks() && line.number(t[0]) && line.blanks() &&
             line.number(t[1]) && line.blanks() && line.number(t[2]) && line.ends();
    };
    const auto take = [&](std::span<const IndexTriangle> read, std::size_t position) {
      const std::size_t room = source_.options.max_triangles - faces_.triangles();
      const std::size_t count = std::min(read.size(), room);
      for (const IndexTriangle& t : read.first(count)) {
        guard_.step(faces_.triangles(), position);
        faces_.add_triangle(t);
      }
      return count;
    };
    if (!text_.next_anywhere()) return;
    text_.go_to(read_plain_lines<IndexTriangle>(source_.bytes, text_.position(), parse, take));
  }

  void read_point() {
    const std::size_t start = text_.position();
    std::array<double, 4> numbers;
    numbers.fill(std::numeric_limits<double>::quiet_NaN());
    const std::size_t wanted = header_.homogeneous ? 4 : 3;
    std::size_t found = 0;
    while (found < wanted && next_number() && text_.read_real(numbers[found])) ++found;
    if (found < 3 && result_.report.bad_points++ == 0) first_bad_.point = start;
    const double scale = found == 4 ? numbers[3] : 1.0;
    result_.soup.points.push_back(Vec3d(numbers[0], numbers[1], numbers[2]) / scale);
    if (lines_count_) {
      text_.skip_line();
    } else {
      for (; found < header_.numbers_per_point() && next_number(); ++found) text_.skip_token();
    }
  }

  void read_faces() {
    while (text_.next_anywhere()) {
      const std::size_t start = text_.position();
      guard_.step(faces_.triangles(), start);
      if (!read_face()) {
        const bool promised = faces_.size() + result_.report.bad_faces < header_.faces;
        if (promised && result_.report.bad_faces++ == 0) first_bad_.face = start;
        // Without lines there is no telling where the next face begins.
        if (!promised || !lines_count_) return ignore_rest(start);
      }
      if (lines_count_) text_.skip_line();
    }
    // The last number of a cut file may be cut too.
    const bool cut = faces_.size() < header_.faces && !source_.bytes.ends_with('\n');
    if (cut && last_face_end_ == source_.bytes.size()) faces_.drop_face();
  }

  bool read_face() {
    std::int64_t corners = 0;
    std::int64_t index = 0;
    if (!text_.read_integer(corners) || corners < 0) return false;
    faces_.begin_face();
    for (std::int64_t i = 0; i < corners; ++i) {
      if (!next_number() || !text_.read_integer(index)) {
        faces_.drop_face();
        return false;
      }
      faces_.add_corner(index);
    }
    faces_.end_face();
    last_face_end_ = text_.position();
    return true;
  }

  void ignore_rest(std::size_t start) {
    result_.report.trailing_bytes = source_.bytes.size() - start;
    result_.report.warnings.push_back({WarningCode::bytes_ignored,
                                       counted(result_.report.trailing_bytes, "byte") +
                                           " after the last face ignored (from line " +
                                           std::to_string(source_.line_at(start)) + ")",
                                       {{"bytes", result_.report.trailing_bytes}}});
  }

  void report_losses() {
    ReadReport& report = result_.report;
    const std::size_t points = result_.soup.points.size();
    const std::size_t lines = faces_.size() + report.bad_faces;
    report.missing_faces = header_.faces > lines ? header_.faces - lines : 0;
    if (points != header_.points || lines != header_.faces) {
      report.warnings.push_back({WarningCode::file_cut_off,
                                 "the header promises " + counted(header_.points, "point") +
                                     " and " + counted(header_.faces, "face") +
                                     ", the file holds " + std::to_string(points) + " and " +
                                     std::to_string(lines),
                                 {{"promised", header_.faces}, {"found", lines}}});
    }
    warn_of_bad(report, source_, first_bad_, "face", "cut, or no numbers of points");
  }

  const MeshSource& source_;
  OffHeader header_;
  TextScanner text_;
  ReadResult result_;
  FaceList faces_;
  ReadGuard guard_;
  bool lines_count_ = true;
  std::size_t last_face_end_ = 0;
  FirstBad first_bad_;
};

}  // namespace

bool begins_with_off(std::string_view bytes) {
  TextScanner text(bytes, kOffText);
  OffHeader header;
  return text.next_anywhere() && parse_off_keyword(text.peek_token(), header) > 0;
}

ReadResult read_off(const MeshSource& source) {
  return read_off_header(source).binary ? read_off_binary(source) : OffReader(source).run();
}

std::string format_off(const TriangleSoup& soup, const std::vector<std::string>& comments) {
  std::string out = "OFF\n";
  for (const std::string& comment : comments) out += "# " + comment + "\n";
  append_triple(out, std::array<std::size_t, 3>{soup.points.size(), soup.triangles.size(), 0});
  out += '\n';
  append_mesh_lines(out, soup);
  return out;
}

}  // namespace meshrepair
