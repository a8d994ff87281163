// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <mesh/read_guard.h>

#include "formats/common/point_columns.h"
#include "formats/common/text_scanner.h"
#include "obj_io.h"

namespace meshrepair {
namespace {

class ObjPoints {
 public:
  ObjPoints(const MeshSource& source, const PointReadOptions& options)
      : source_(source),
        text_(source.bytes, {.comment = '#', .continuation = true}),
        options_(options),
        guard_(source) {}

  PointReadResult run() {
    result_.report.format = PointFormat::obj;
    while (text_.next_anywhere()) {
      line_at_ = text_.position();
      guard_.step(0, line_at_);
      const std::string_view word = text_.peek_token();
      text_.skip_token();
      if (word == "v") {
        read_point();
      } else if (word == "vn") {
        read_normal();
      }
      text_.skip_line();
    }
    finish();
    return std::move(result_);
  }

 private:
  std::size_t read_numbers(std::array<double, 6>& numbers) {
    std::size_t count = 0;
    while (count < numbers.size() && text_.next_on_line() && text_.read_real(numbers[count]))
      ++count;
    return count;
  }

  void read_point() {
    std::array<double, 6> numbers = {};
    const std::size_t count = read_numbers(numbers);
    ++points_;
    if (count < 3) {
      if (result_.report.bad_points++ == 0) first_bad_ = line_at_;
      return;
    }
    owners_.push_back(points_ - 1);
    result_.cloud.points.emplace_back(numbers[0], numbers[1], numbers[2]);
    if (count == 6) ++coloured_;
    if (options_.colours) {
      result_.cloud.colours.push_back(
          {to_colour(255 * numbers[3]), to_colour(255 * numbers[4]), to_colour(255 * numbers[5])});
    }
  }

  void read_normal() {
    std::array<double, 6> numbers = {};
    const std::size_t count = read_numbers(numbers);
    normals_.emplace_back(count < 3 ? Vec3d(0, 0, 0) : Vec3d(numbers[0], numbers[1], numbers[2]));
  }

  void finish() {
    PointReadReport& report = result_.report;
    PointCloud& cloud = result_.cloud;
    report.colours = !cloud.points.empty() && coloured_ == cloud.points.size();
    if (!report.colours) cloud.colours.clear();
    report.normals = !cloud.points.empty() && normals_.size() == points_;
    if (report.normals && options_.normals) {
      for (const std::size_t owner : owners_) cloud.normals.push_back(normals_[owner]);
    }
    if (report.bad_points > 0) {
      report.warnings.push_back({WarningCode::points_unreadable,
                                 "coordinates of " + counted(report.bad_points, "point") +
                                     " are missing or not numbers (first: line " +
                                     std::to_string(source_.line_at(first_bad_)) + ")",
                                 {{"points", report.bad_points}}});
    }
  }

  const MeshSource& source_;
  TextScanner text_;
  const PointReadOptions& options_;
  ReadGuard guard_;
  PointReadResult result_;
  std::vector<Vec3d> normals_;
  std::vector<std::size_t> owners_;  // of each point: its number in the file, bad ones counted
  std::size_t points_ = 0;
  std::size_t coloured_ = 0;
  std::size_t line_at_ = 0;
  std::size_t first_bad_ = 0;
};

}  // namespace

PointReadResult read_obj_points(const MeshSource& source, const PointReadOptions& options) {
  return ObjPoints(source, options).run();
}

}  // namespace meshrepair
