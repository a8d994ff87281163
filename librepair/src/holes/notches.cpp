// SPDX-License-Identifier: MIT
#include "notches.h"

#include <algorithm>
#include <queue>
#include <utility>

namespace meshrepair::internal {
namespace {

constexpr double kWidestCosine = -0.5;

// Of a notch, as a share of the length of the rim.
constexpr double kWidestNotch = 0.1;

// As fold_cosine() has it: the triangle bends from the surface by up to 60 degrees.
constexpr double kMostBend = -0.5;

class NotchFiller {
 public:
  explicit NotchFiller(const Rim& rim)
      : points_(rim.points), apex_(rim.apex), gone_(rim.size(), 0), left_(rim.size()) {
    const auto n = static_cast<std::uint32_t>(rim.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      before_.push_back(i == 0 ? n - 1 : i - 1);
      after_.push_back(i + 1 == n ? 0 : i + 1);
      length_ += (points_[after_[i]] - points_[i]).norm();
    }
  }

  FilledNotches run() {
    for (std::uint32_t i = 0; i < points_.size(); ++i) look_at(i);
    while (!found_.empty() && left_ > 3) {
      const Notch notch = found_.top();
      found_.pop();
      const std::uint32_t b = notch.at, a = before_[b], c = after_[b];
      if (gone_[b] != 0 || notch.before != a || notch.after != c) continue;
      fill(a, b, c);
    }
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      if (gone_[i] != 0) continue;
      filled_.left.push_back(i);
      filled_.rim.points.push_back(points_[i]);
      filled_.rim.apex.push_back(apex_[i]);
    }
    return std::move(filled_);
  }

 private:
  struct Notch {
    double cosine;  // of its angle
    std::uint32_t at, before, after;

    bool operator<(const Notch& other) const {
      return cosine != other.cosine ? cosine < other.cosine : at > other.at;
    }
  };

  void look_at(std::uint32_t b) {
    const std::uint32_t a = before_[b], c = after_[b];
    const Vec3d &from = points_[a], &at = points_[b], &to = points_[c];
    if ((to - from).norm() > kWidestNotch * length_) return;
    const double cosine = (from - at).normalized().dot((to - at).normalized());
    if (!(cosine > kWidestCosine)) return;
    if (fold_cosine(from, at, apex_[a], to) > kMostBend) return;
    if (fold_cosine(at, to, apex_[b], from) > kMostBend) return;
    found_.push({cosine, b, a, c});
  }

  void fill(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    std::array<std::uint32_t, 3> corners = {a, b, c};
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    filled_.triangles.push_back(corners);
    filled_.area += triangle_area(points_[a], points_[b], points_[c]);
    gone_[b] = 1;
    --left_;
    after_[a] = c;
    before_[c] = a;
    apex_[a] = points_[b];
    look_at(a);
    look_at(c);
  }

  const std::vector<Vec3d>& points_;
  std::vector<Vec3d> apex_;  // of the edge from each point on
  std::vector<std::uint32_t> before_, after_;
  std::vector<char> gone_;
  std::size_t left_;
  double length_ = 0;
  std::priority_queue<Notch> found_;
  FilledNotches filled_;
};

}  // namespace

FilledNotches fill_notches(const Rim& rim) { return NotchFiller(rim).run(); }

}  // namespace meshrepair::internal
