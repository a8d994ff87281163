// SPDX-License-Identifier: MIT
// The triangulation of a loop by a dynamic programme over its chords (G. Klincsek 1980; G. Barequet
// and M. Sharir 1995): the best triangulation between the points i and j is that with the best
// third corner in between. The cost is the area, and for an edge whose two triangles fold over each
// other up to the area of the smaller one again: a patch that lies on itself, or on the surface
// beyond the rim, has saved no area. Time grows with the third power of the loop, so long loops are
// cut in two by a short chord first.
//
// A ring between two loops is the cheapest way around both, one step on one of them after the
// other, from the two points that are nearest to each other (H. Fuchs, Z. Kedem and S. Uselton,
// Optimal surface reconstruction from planar contours, 1977).
#include "loop_triangulation.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace meshrepair::internal {
namespace {

// So many points offer a chord when a large loop is cut in two.
constexpr std::size_t kOffers = 64;

// A chord leaves a triangle or more on each side.
constexpr std::size_t kFewestCut = 8;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

using RimPlaces = std::vector<std::uint32_t>;

// What the edge p q costs between triangles with the third corners a and b of the patch: nothing up
// to a right angle between them, and the smaller one's area if one lies on the other.
double fold_cost(const Vec3d& p, const Vec3d& q, const Vec3d& a, const Vec3d& b) {
  const double cosine = fold_cosine(p, q, a, b);
  return cosine <= 0 ? 0 : cosine * std::min(triangle_area(p, q, a), triangle_area(p, q, b));
}

// The same between the surface, of which only a first triangle is known, and the patch.
double border_fold_cost(const Vec3d& p, const Vec3d& q, const Vec3d& surface, const Vec3d& patch) {
  const double cosine = fold_cosine(p, q, surface, patch);
  return cosine <= 0 ? 0 : cosine * triangle_area(p, q, patch);
}

// The dynamic programme over all chords of one loop.
class BestTriangulation {
 public:
  // Chords that cut this loop from a larger one have no apex: nothing is known beyond.
  BestTriangulation(const Rim& rim, const RimPlaces& loop)
      : rim_(rim),
        loop_(loop),
        size_(loop.size()),
        cost_(size_ * size_, 0),
        third_(size_ * size_, 0) {}

  void run(const std::function<void()>& poll, LoopTriangulation& result) {
    for (std::size_t gap = 2; gap < size_; ++gap) {
      if (poll) poll();
      for (std::size_t i = 0; i + gap < size_; ++i) choose_third(i, i + gap);
    }
    collect(result);
  }

 private:
  void choose_third(std::size_t i, std::size_t j) {
    double best = kInfinite;
    std::size_t best_third = i + 1;
    for (std::size_t m = i + 1; m < j; ++m) {
      double cost = cost_[i * size_ + m] + cost_[m * size_ + j];
      if (cost >= best) continue;
      cost += triangle_area(at(i), at(m), at(j));
      if (cost >= best) continue;
      cost += fold_over(i, m, j) + fold_over(m, j, i);
      if (i == 0 && j + 1 == size_) cost += fold_over(j, i, m);
      if (cost >= best) continue;
      best = cost;
      best_third = m;
    }
    cost_[i * size_ + j] = best;
    third_[i * size_ + j] = static_cast<std::uint32_t>(best_third);
  }

  // Between the triangle with third corner `third` and what lies beyond the chord or edge i j.
  [[nodiscard]] double fold_over(std::size_t i, std::size_t j, std::size_t third) const {
    const bool is_edge = (i + 1) % size_ == j;
    if (!is_edge) return fold_cost(at(i), at(j), at(third_[i * size_ + j]), at(third));
    const bool is_border = (loop_[i] + 1) % rim_.size() == loop_[j];
    return is_border ? border_fold_cost(at(i), at(j), rim_.apex[loop_[i]], at(third)) : 0;
  }

  void collect(LoopTriangulation& result) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> chords;
    chords.emplace_back(0, static_cast<std::uint32_t>(size_ - 1));
    while (!chords.empty()) {
      const auto [i, j] = chords.back();
      chords.pop_back();
      if (j - i < 2) continue;
      const std::uint32_t m = third_[i * size_ + j];
      result.triangles.push_back({loop_[i], loop_[m], loop_[j]});
      result.area += triangle_area(at(i), at(m), at(j));
      chords.emplace_back(m, j);
      chords.emplace_back(i, m);
    }
  }

  [[nodiscard]] const Vec3d& at(std::size_t i) const { return rim_.points[loop_[i]]; }

  const Rim& rim_;
  const RimPlaces& loop_;
  std::size_t size_;
  std::vector<double> cost_;
  std::vector<std::uint32_t> third_;
};

// The shortest of the chords looked at that leave a quarter of the points or more on each side.
std::pair<std::size_t, std::size_t> choose_chord(const Rim& rim, const RimPlaces& loop) {
  const std::size_t n = loop.size();
  const std::size_t step = std::max<std::size_t>(1, n / kOffers);
  double best = kInfinite;
  std::pair<std::size_t, std::size_t> chord;
  for (std::size_t i = 0; i < n; i += step) {
    for (std::size_t k = n / 4; k <= n - n / 4; ++k) {
      const std::size_t j = (i + k) % n;
      const double length = (rim.points[loop[j]] - rim.points[loop[i]]).squaredNorm();
      if (length >= best) continue;
      best = length;
      chord = std::minmax(i, j);
    }
  }
  return chord;
}

std::pair<RimPlaces, RimPlaces> cut(const RimPlaces& loop,
                                    const std::pair<std::size_t, std::size_t>& chord) {
  const auto from = loop.begin() + static_cast<std::ptrdiff_t>(chord.first);
  const auto to = loop.begin() + static_cast<std::ptrdiff_t>(chord.second);
  std::pair<RimPlaces, RimPlaces> halves;
  halves.first.assign(from, to + 1);
  halves.second.assign(loop.begin(), from + 1);
  halves.second.insert(halves.second.end(), to, loop.end());
  return halves;
}

}  // namespace

LoopTriangulation triangulate_loop(const Rim& rim, const LoopTriangulationOptions& options) {
  LoopTriangulation result;
  std::vector<RimPlaces> loops(1, RimPlaces(rim.size()));
  for (std::uint32_t i = 0; i < rim.size(); ++i) loops[0][i] = i;
  while (!loops.empty()) {
    const RimPlaces loop = std::move(loops.back());
    loops.pop_back();
    if (loop.size() > std::max(options.most_edges, kFewestCut)) {
      auto [a, b] = cut(loop, choose_chord(rim, loop));
      loops.push_back(std::move(b));
      loops.push_back(std::move(a));
      if (options.poll) options.poll();
    } else {
      BestTriangulation(rim, loop).run(options.poll, result);
    }
  }
  return result;
}

double least_area(const Rim& rim) { return 0.5 * twice_vector_area(rim.points).norm(); }

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
