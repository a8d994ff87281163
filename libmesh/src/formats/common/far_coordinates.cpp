// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <system_error>
#include <vector>

#include <Eigen/Geometry>

#include <base/decimal.h>
#include <base/roots.h>
#include <mesh/far_coordinates.h>
#include <mesh/precision.h>

#include "text_writer.h"

namespace meshrepair {
namespace {

// A share of the diagonal that no print, screen or solver shows, and of the distance of neighbours,
// below which faces keep their directions.
constexpr double kShareOfDiagonal = 1e-5;
constexpr double kShareOfSpacing = 0.01;

Eigen::AlignedBox3d box_of(std::span<const Vec3d> points) {
  Eigen::AlignedBox3d box;
  for (const Vec3d& point : points) {
    if (point.allFinite()) box.extend(point);
  }
  return box;
}

bool is_much(double move, double diagonal, double spacing) {
  return move > kShareOfDiagonal * diagonal || (spacing > 0 && move > kShareOfSpacing * spacing);
}

double largest_coordinate(const Eigen::AlignedBox3d& box) {
  return box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
}

// Of so few digits that it is still near the middle.
double rounded_middle(double middle, double size) {
  const int digits = decimal_exponent(size);
  const double power = power_of_ten(std::abs(digits));
  return digits < 0 ? std::round(middle * power) / power : std::round(middle / power) * power;
}

}  // namespace

SinglePrecisionLoss single_precision_loss(std::span<const Vec3d> points, double spacing) {
  SinglePrecisionLoss loss;
  const Eigen::AlignedBox3d box = box_of(points);
  if (box.isEmpty()) return loss;
  loss.diagonal = box.diagonal().norm();
  loss.step = internal::number_spacing(largest_coordinate(box), Precision::float32);
  for (const Vec3d& point : points) {
    if (point.allFinite()) {
      loss.move = std::max(loss.move, (rounded_to_float32(point) - point).norm());
    }
  }
  loss.matters = is_much(loss.move, loss.diagonal, spacing);
  return loss;
}

double typical_edge(const TriangleSoup& soup) {
  constexpr std::size_t kMost = 10'000;
  const std::size_t stride = soup.triangles.size() / kMost + 1;
  std::vector<double> shortest;
  for (std::size_t t = 0; t < soup.triangles.size(); t += stride) {
    const auto& corners = soup.triangles[t];
    double length = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d edge = soup.points[corners[k]] - soup.points[corners[(k + 1) % 3]];
      length = std::min(length, edge.norm());
    }
    if (length > 0 && std::isfinite(length)) shortest.push_back(length);
  }
  if (shortest.empty()) return 0;
  const auto middle = shortest.begin() + static_cast<std::ptrdiff_t>(shortest.size() / 2);
  std::nth_element(shortest.begin(), middle, shortest.end());
  return *middle;
}

Vec3d fitting_offset(std::span<const Vec3d> points, double spacing) {
  Vec3d offset = Vec3d::Zero();
  const Eigen::AlignedBox3d box = box_of(points);
  if (box.isEmpty()) return offset;
  const double diagonal = box.diagonal().norm(), largest = largest_coordinate(box);
  const double step = internal::number_spacing(largest, Precision::float32);
  if (!std::isfinite(diagonal) || !is_much(step / 2, diagonal, spacing)) return offset;
  // Both x and the offset are then within a fourth of the middle, and x - offset is exact, as by
  // Sterbenz a difference is whose numbers are at most a factor of 2 apart.
  constexpr double kNear = 0.125;
  for (int axis = 0; axis < 3; ++axis) {
    const double middle = box.center()[axis];
    const double size = std::max(box.sizes()[axis], std::min(diagonal, std::abs(middle) * kNear));
    if (!(size > 0) || size > kNear * std::abs(middle)) continue;
    const double rounded = rounded_middle(middle, size);
    if (std::abs(rounded - middle) <= kNear * std::abs(middle)) offset[axis] = rounded;
  }
  return offset;
}

void move_points(std::span<Vec3d> points, const Vec3d& by) {
  if (by == Vec3d::Zero()) return;  // not even the sign of a zero changes
  for (Vec3d& point : points) point += by;
}

std::string offset_comment(const Vec3d& offset) {
  std::string text = "offset";
  for (const double coordinate : offset) {
    text += ' ';
    constexpr double kPlain = 1e15;  // "500000", not "5e+05"
    if (std::abs(coordinate) < kPlain && std::round(coordinate) == coordinate) {
      append_number(text, static_cast<std::int64_t>(coordinate));
    } else {
      append_number(text, coordinate);
    }
  }
  return text;
}

namespace {

// Without the mark of a comment; nothing where the line is none.
std::optional<std::string_view> comment_in(std::string_view line) {
  for (const std::string_view mark : {"#", "//", "comment "}) {
    if (line.starts_with(mark)) return line.substr(mark.size());
  }
  return std::nullopt;
}

std::string_view next_word(std::string_view& text) {
  constexpr std::string_view kBetween = " \t\r,;:=";
  const std::size_t first = std::min(text.find_first_not_of(kBetween), text.size());
  const std::size_t last = std::min(text.find_first_of(kBetween, first), text.size());
  const std::string_view word = text.substr(first, last - first);
  text.remove_prefix(last);
  return word;
}

bool is_offset(std::string_view word) {
  constexpr std::string_view kOffset = "offset";
  return word.size() == kOffset.size() &&
         std::equal(word.begin(), word.end(), kOffset.begin(),
                    [](char a, char b) { return (a | 0x20) == b; });
}

std::optional<Vec3d> offset_in(std::string_view comment) {
  if (!is_offset(next_word(comment))) return std::nullopt;
  Vec3d offset;
  for (double& coordinate : offset) {
    const std::string_view word = next_word(comment);
    const auto read = read_decimal(word.data(), word.data() + word.size(), coordinate);
    if (word.empty() || read.ec != std::errc() || read.ptr != word.data() + word.size())
      return std::nullopt;
  }
  if (!next_word(comment).empty() || !offset.allFinite()) return std::nullopt;
  return offset;
}

}  // namespace

std::optional<Vec3d> find_offset_comment(std::string_view bytes) {
  constexpr std::size_t kMostBytes = 16'384, kMostLines = 200;
  bytes = bytes.substr(0, kMostBytes);
  for (std::size_t line = 0; line < kMostLines && !bytes.empty(); ++line) {
    const std::size_t end = std::min(bytes.find('\n'), bytes.size());
    if (const auto comment = comment_in(bytes.substr(0, end))) {
      if (auto offset = offset_in(*comment)) return offset;
    }
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
  }
  return std::nullopt;
}

}  // namespace meshrepair
