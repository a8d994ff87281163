#include "triangulate_polygon.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

namespace meshrepair {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Flat = Eigen::Vector2d;

// Beyond, the quadratic time of ear clipping would let a small file keep the reader busy for
// minutes.
constexpr std::size_t kMostEars = 4096;

std::vector<std::uint32_t> without_repetitions(std::span<const std::uint32_t> corners) {
  std::vector<std::uint32_t> kept;
  kept.reserve(corners.size());
  std::size_t droppable = corners.size() - 3;
  for (const std::uint32_t corner : corners) {
    const bool repeated = !kept.empty() && kept.back() == corner;
    if (repeated && droppable > 0) {
      --droppable;
    } else {
      kept.push_back(corner);
    }
  }
  for (; droppable > 0 && kept.back() == kept.front(); --droppable) kept.pop_back();
  return kept;
}

void append_fan(std::span<const std::uint32_t> corners, Triangles& triangles) {
  for (std::size_t i = 2; i < corners.size(); ++i) {
    triangles.push_back({corners[0], corners[i - 1], corners[i]});
  }
}

// Twice the vector area (Newell), about the first corner.
Vec3d area_vector(const std::vector<Vec3d>& points, std::span<const std::uint32_t> corners) {
  const Vec3d& origin = points[corners[0]];
  Vec3d sum = Vec3d::Zero();
  for (std::size_t i = 2; i < corners.size(); ++i) {
    sum += (points[corners[i - 1]] - origin).cross(points[corners[i]] - origin);
  }
  return sum;
}

// The corners without the coordinate in which the area vector is largest, mirrored where needed so
// that the polygon turns to the left.
std::vector<Flat> flatten(const std::vector<Vec3d>& points, std::span<const std::uint32_t> corners,
                          const Vec3d& area) {
  Eigen::Index drop = 0;
  area.cwiseAbs().maxCoeff(&drop);
  Eigen::Index u = (drop + 1) % 3;
  Eigen::Index v = (drop + 2) % 3;
  if (area[drop] < 0) std::swap(u, v);
  std::vector<Flat> flat;
  flat.reserve(corners.size());
  for (const std::uint32_t corner : corners)
    flat.emplace_back(points[corner][u], points[corner][v]);
  return flat;
}

// Positive when a, b, c turn to the left. Rounded: a wrong sign costs a sliver, not validity.
double turn(const Flat& a, const Flat& b, const Flat& c) {
  const Flat ab = b - a;
  const Flat ac = c - a;
  return ab.x() * ac.y() - ab.y() * ac.x();
}

bool is_star_shaped_from_first(const std::vector<Flat>& flat) {
  for (std::size_t i = 2; i < flat.size(); ++i) {
    if (!(turn(flat[0], flat[i - 1], flat[i]) > 0)) return false;
  }
  return true;
}

// The polygon that is left, as a ring of positions in `flat`.
class EarClipper {
 public:
  EarClipper(const std::vector<Flat>& flat, std::span<const std::uint32_t> corners)
      : flat_(flat), corners_(corners), next_(flat.size()), previous_(flat.size()) {
    for (std::size_t i = 0; i < flat.size(); ++i) {
      next_[i] = (i + 1) % flat.size();
      previous_[next_[i]] = i;
    }
  }

  // False, with nothing appended, when the polygon has no ear before three corners are left.
  bool run(Triangles& triangles) {
    const std::size_t count_before = triangles.size();
    std::size_t corner = 0;
    for (std::size_t left = flat_.size(); left > 3; --left) {
      std::size_t tried = 0;
      while (tried < left && !is_ear(corner)) {
        corner = next_[corner];
        ++tried;
      }
      if (tried == left) {
        triangles.resize(count_before);
        return false;
      }
      triangles.push_back(triangle(corner));
      next_[previous_[corner]] = next_[corner];
      previous_[next_[corner]] = previous_[corner];
      corner = next_[corner];
    }
    triangles.push_back(triangle(corner));
    return true;
  }

 private:
  [[nodiscard]] std::array<std::uint32_t, 3> triangle(std::size_t corner) const {
    return {corners_[previous_[corner]], corners_[corner], corners_[next_[corner]]};
  }

  [[nodiscard]] bool is_ear(std::size_t corner) const {
    const Flat& a = flat_[previous_[corner]];
    const Flat& b = flat_[corner];
    const Flat& c = flat_[next_[corner]];
    if (!(turn(a, b, c) > 0)) return false;
    for (std::size_t i = next_[next_[corner]]; i != previous_[corner]; i = next_[i]) {
      if (is_reflex(i) && blocks(flat_[i], a, b, c)) return false;
    }
    return true;
  }

  // Only reflex corners can lie in an ear without others lying there too.
  [[nodiscard]] bool is_reflex(std::size_t corner) const {
    return turn(flat_[previous_[corner]], flat_[corner], flat_[next_[corner]]) <= 0;
  }

  // The bridge to a hole passes through the same points twice: those at a corner do not block.
  [[nodiscard]] static bool blocks(const Flat& p, const Flat& a, const Flat& b, const Flat& c) {
    if (p == a || p == b || p == c) return false;
    return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
  }

  const std::vector<Flat>& flat_;
  std::span<const std::uint32_t> corners_;
  std::vector<std::size_t> next_;
  std::vector<std::size_t> previous_;
};

}  // namespace

void triangulate_polygon(const std::vector<Vec3d>& points, std::span<const std::uint32_t> corners,
                         Triangles& triangles) {
  const std::vector<std::uint32_t> ring = without_repetitions(corners);
  if (ring.size() == 3 || ring.size() > kMostEars) return append_fan(ring, triangles);
  const Vec3d area = area_vector(points, ring);
  if (!area.allFinite() || area.isZero(0)) return append_fan(ring, triangles);
  const std::vector<Flat> flat = flatten(points, ring, area);
  if (is_star_shaped_from_first(flat) || !EarClipper(flat, ring).run(triangles)) {
    append_fan(ring, triangles);
  }
}

}  // namespace meshrepair
