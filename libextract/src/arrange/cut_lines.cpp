// SPDX-License-Identifier: MIT
#include "cut_lines.h"

#include <algorithm>

#include <exact/predicates.h>

namespace meshrepair::internal {
namespace {

struct Reach {
  std::array<double, 3> low{}, high{};

  Reach() = default;
  Reach(const Point& p, const Point& q) {
    const double slack = 2 * static_cast<double>(p.error + q.error);
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(p.position[k], q.position[k]) - slack;
      high[k] = std::max(p.position[k], q.position[k]) + slack;
    }
  }
  [[nodiscard]] bool meets(const Reach& other) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (low[k] > other.high[k] || other.low[k] > high[k]) return false;
    }
    return true;
  }
};

class LineFinder {
 public:
  LineFinder(const CutSet& cut, const ArrangedPoints& points, std::uint32_t triangle)
      : cut_(cut), points_(points), triangle_(triangle) {}

  CutLines run(std::span<const CutSegment> segments, std::span<const std::uint32_t> contacts) {
    for (const CutSegment& s : segments) add(s);
    compare_all();
    for (const std::uint32_t contact : contacts) compare_with(contact);
    return std::move(result_);
  }

 private:
  void add(const CutSegment& s) {
    const std::uint32_t from = points_.find(s.from), to = points_.find(s.to);
    result_.sound &= from != kNone && to != kNone;
    if (!result_.sound) return;
    const bool is_known =
        s.edge != kNone && std::any_of(result_.lines.begin(), result_.lines.end(),
                                       [&](const CutLine& l) { return l.edge == s.edge; });
    if (is_known) return;  // two triangles at one edge of which it lies in this one
    result_.lines.push_back({from, to, s.by, s.edge, s.plane});
    ends_.push_back({points_.at(from), points_.at(to)});
    reach_.emplace_back(ends_.back()[0], ends_.back()[1]);
  }

  // By a sweep along the axis on which they reach farthest.
  void compare_all() {
    const std::size_t axis = widest_axis();
    std::vector<std::uint32_t> order(result_.lines.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
      const double a = reach_[i].low[axis], b = reach_[j].low[axis];
      return a != b ? a < b : i < j;
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
      const Reach& reach = reach_[order[i]];
      for (std::size_t j = i + 1; j < order.size(); ++j) {
        if (reach_[order[j]].low[axis] > reach.high[axis]) break;
        if (reach.meets(reach_[order[j]])) compare(order[i], order[j]);
      }
    }
  }

  [[nodiscard]] std::size_t widest_axis() const {
    std::array<double, 3> low{}, high{};
    for (std::size_t i = 0; i < reach_.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = i == 0 ? reach_[i].low[k] : std::min(low[k], reach_[i].low[k]);
        high[k] = i == 0 ? reach_[i].high[k] : std::max(high[k], reach_[i].high[k]);
      }
    }
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    }
    return axis;
  }

  [[nodiscard]] int side_of(const Point& p, const CutLine& line) const {
    return side(p, line.plane, cut_.planes());
  }

  void compare(std::uint32_t i, std::uint32_t j) {
    const CutLine& a = result_.lines[i];
    const CutLine& b = result_.lines[j];
    const int b0 = side_of(ends_[j][0], a), b1 = side_of(ends_[j][1], a);
    if (b0 * b1 > 0) return;
    const int a0 = side_of(ends_[i][0], b), a1 = side_of(ends_[i][1], b);
    if (a0 * a1 > 0) return;
    if (b0 == 0 && b1 == 0) return lie_in_one_line(i, j);
    if (b0 * b1 < 0 && a0 * a1 < 0) return cross(i, j);
    const std::uint32_t end_of_a = a0 == 0 ? a.from : a.to;
    const std::uint32_t end_of_b = b0 == 0 ? b.from : b.to;
    const bool a_ends = a0 * a1 == 0, b_ends = b0 * b1 == 0;
    if (a_ends && b_ends) {
      if (end_of_a != end_of_b) result_.same.push_back({end_of_a, end_of_b});
    } else if (a_ends) {
      add_point(j, end_of_a);
    } else {
      add_point(i, end_of_b);
    }
  }

  void add_point(std::uint32_t line, std::uint32_t point) {
    result_.points.push_back({line, point, {}});
  }

  void cross(std::uint32_t i, std::uint32_t j) {
    const CutLine& a = result_.lines[i];
    const CutLine& b = result_.lines[j];
    LinePoint point;
    if (a.edge == kNone && b.edge == kNone) {
      point.triple = {triangle_, a.by, b.by};
      std::sort(point.triple.begin(), point.triple.end());
    } else {
      const PointName name = a.edge == kNone   ? PointName::edge_and_triangle(b.edge, a.by)
                             : b.edge == kNone ? PointName::edge_and_triangle(a.edge, b.by)
                                               : PointName::two_edges(a.edge, b.edge);
      point.point = points_.find(name);
      result_.sound &= point.point != kNone;
    }
    point.line = i;
    result_.points.push_back(point);
    point.line = j;
    result_.points.push_back(point);
  }

  [[nodiscard]] Direction direction(const CutLine& line) const {
    return direction_of(cut_.planes()[cut_.plane(triangle_)], cut_.planes()[line.plane]);
  }

  // Whether a point in the line of one of them lies between its ends; at an end they are joined.
  void look_between(std::uint32_t i, std::uint32_t point, const Point& at) {
    const CutLine& line = result_.lines[i];
    const Direction along = direction(line);
    const int after = order_along(along, ends_[i][0], at, cut_.planes());
    const int before = order_along(along, at, ends_[i][1], cut_.planes());
    if (after == 0 && point != line.from) result_.same.push_back({point, line.from});
    if (before == 0 && point != line.to) result_.same.push_back({point, line.to});
    if (after * before > 0) add_point(i, point);
  }

  void lie_in_one_line(std::uint32_t i, std::uint32_t j) {
    look_between(i, result_.lines[j].from, ends_[j][0]);
    look_between(i, result_.lines[j].to, ends_[j][1]);
    look_between(j, result_.lines[i].from, ends_[i][0]);
    look_between(j, result_.lines[i].to, ends_[i][1]);
  }

  void compare_with(std::uint32_t contact) {
    const Point at = points_.at(contact);
    const Reach reach(at, at);
    for (std::uint32_t i = 0; i < result_.lines.size(); ++i) {
      if (!reach.meets(reach_[i]) || side_of(at, result_.lines[i]) != 0) continue;
      look_between(i, contact, at);
    }
  }

  const CutSet& cut_;
  const ArrangedPoints& points_;
  const std::uint32_t triangle_;
  std::vector<std::array<Point, 2>> ends_;
  std::vector<Reach> reach_;
  CutLines result_;
};

}  // namespace

CutLines find_cut_lines(const CutSet& cut, const ArrangedPoints& points, std::uint32_t triangle,
                        std::span<const CutSegment> segments,
                        std::span<const std::uint32_t> contacts) {
  return LineFinder(cut, points, triangle).run(segments, contacts);
}

}  // namespace meshrepair::internal
