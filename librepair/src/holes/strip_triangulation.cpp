#include "strip_triangulation.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace meshrepair::internal {
namespace {

struct NearestPoints {
  std::size_t a = 0, b = 0;
};

NearestPoints find_nearest(const Rim& a, const Rim& b) {
  NearestPoints nearest;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      const double distance = (a.points[i] - b.points[j]).squaredNorm();
      if (distance >= least) continue;
      least = distance;
      nearest = {i, j};
    }
  }
  return nearest;
}

// Goes round both loops from the nearest points on; each triangle takes one step on one of them.
class StripProgramme {
 public:
  StripProgramme(const Rim& a, const Rim& b, const NearestPoints& start, bool forward)
      : a_(a),
        b_(b),
        start_(start),
        forward_(forward),
        columns_(b.size() + 1),
        along_a_((a.size() + 1) * columns_, 0) {}

  StripTriangulation run() {
    find_cheapest();
    StripTriangulation strip;
    std::size_t sharp = 0;
    std::size_t i = a_.size(), j = b_.size();
    while (i + j > 0) {
      const bool step_on_a = along_a_[i * columns_ + j] != 0;
      if (step_on_a) {
        strip.triangles.push_back({at_a(i - 1), at_a(i), at_b(j)});
        sharp += is_sharp_fold(a_, edge_of_a(i - 1), b_.points[in_b(j)]);
        --i;
      } else {
        strip.triangles.push_back({at_b(j), at_b(j - 1), at_a(i)});
        sharp += is_sharp_fold(b_, edge_of_b(j - 1), a_.points[in_a(i)]);
        --j;
      }
    }
    strip.area = area_;
    strip.folded = 2 * sharp > a_.size() + b_.size();
    return strip;
  }

 private:
  void find_cheapest() {
    std::vector<double> above(columns_), row(columns_);
    for (std::size_t i = 0; i <= a_.size(); ++i) {
      for (std::size_t j = 0; j < columns_; ++j) {
        double best = i + j > 0 ? std::numeric_limits<double>::infinity() : 0;
        if (j > 0) best = row[j - 1] + area(in_a(i), in_b(j - 1), in_b(j));
        if (i > 0) {
          const double by_a = above[j] + triangle_area(a_.points[in_a(i - 1)], a_.points[in_a(i)],
                                                       b_.points[in_b(j)]);
          if (by_a <= best) {
            best = by_a;
            along_a_[i * columns_ + j] = 1;
          }
        }
        row[j] = best;
      }
      std::swap(above, row);
    }
    area_ = above.back();
  }

  [[nodiscard]] double area(std::size_t of_a, std::size_t first_of_b,
                            std::size_t second_of_b) const {
    return triangle_area(a_.points[of_a], b_.points[first_of_b], b_.points[second_of_b]);
  }

  // Positions in the loops after so many steps.
  [[nodiscard]] std::size_t in_a(std::size_t i) const { return (start_.a + i) % a_.size(); }
  [[nodiscard]] std::size_t in_b(std::size_t j) const {
    return (forward_ ? start_.b + j : start_.b + 2 * b_.size() - j) % b_.size();
  }
  // The edges that the next step goes along.
  [[nodiscard]] std::size_t edge_of_a(std::size_t i) const { return in_a(i); }
  [[nodiscard]] std::size_t edge_of_b(std::size_t j) const { return in_b(forward_ ? j : j + 1); }

  [[nodiscard]] std::uint32_t at_a(std::size_t i) const {
    return static_cast<std::uint32_t>(in_a(i));
  }
  [[nodiscard]] std::uint32_t at_b(std::size_t j) const {
    return static_cast<std::uint32_t>(a_.size() + in_b(j));
  }

  const Rim& a_;
  const Rim& b_;
  NearestPoints start_;
  bool forward_;
  std::size_t columns_;
  std::vector<char> along_a_;
  double area_ = 0;
};

}  // namespace

StripTriangulation triangulate_strip(const Rim& a, const Rim& b) {
  const NearestPoints start = find_nearest(a, b);
  StripTriangulation forward = StripProgramme(a, b, start, true).run();
  StripTriangulation backward = StripProgramme(a, b, start, false).run();
  return forward.area <= backward.area ? forward : backward;
}

}  // namespace meshrepair::internal
