// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <limits>

#include <Eigen/Geometry>

#include <base/parallel.h>
#include <check/internal/triangle_list.h>
#include <check/soup_rays.h>
#include <exact/double_predicates.h>
#include <mesh/edge_table.h>

#include "column_ray.h"

namespace meshrepair {
namespace {

using internal::RayStart;

constexpr std::size_t kTrianglesPerTask = 16384;

std::vector<Box> boxes_of(const TriangleSoup& soup) {
  std::vector<Box> boxes;
  boxes.reserve(soup.triangles.size());
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    boxes.push_back(internal::box_of(soup, t));
  }
  return boxes;
}

// Each is its corner alone.
std::vector<Box> boxes_of(std::span<const RayStart> starts) {
  std::vector<Box> boxes(starts.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i].add(starts[i].corner);
  return boxes;
}

std::vector<RayStart> starts_of(const TriangleSoup& soup, std::span<const CornerRay> rays) {
  std::vector<RayStart> starts;
  starts.reserve(rays.size());
  for (const CornerRay& ray : rays) {
    IndexTriangle corners = soup.triangles[ray.triangle];
    std::rotate(corners.begin(), corners.begin() + ray.corner, corners.end());
    starts.push_back(RayStart::in(soup, corners));
  }
  return starts;
}

struct Passage {
  std::uint32_t ray = 0, triangle = 0;
};

// Of a tree of starts, calls visit(item) for all whose rays may reach the box.
template <class Visit>
void visit_below(const BoxTree& tree, Box box, Visit visit) {
  box.low[2] = -std::numeric_limits<double>::infinity();
  tree.visit([&](const Box& starts) { return starts.meets(box); }, visit);
}

// A segment against boxes: says no only if they do not meet.
class SegmentReach {
 public:
  SegmentReach(const Vec3d& from, const Vec3d& to) {
    own_.add(from);
    own_.add(to);
    const Vec3d along = to - from;
    // Three axes across the segment, and where it lies on them, with room for rounding.
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d axis = along.cross(Vec3d::Unit(static_cast<Eigen::Index>(k)));
      across_[k] = axis;
      const double a = axis.dot(from), b = axis.dot(to);
      const double size = axis.cwiseAbs().dot(from.cwiseAbs().cwiseMax(to.cwiseAbs()));
      at_low_[k] = std::min(a, b) - kRounding * size;
      at_high_[k] = std::max(a, b) + kRounding * size;
    }
  }

  bool operator()(const Box& box) const {
    if (!own_.meets(box)) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      double low = 0, high = 0, size = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const double x = across_[k][static_cast<Eigen::Index>(i)];
        low += std::min(x * box.low[i], x * box.high[i]);
        high += std::max(x * box.low[i], x * box.high[i]);
        size += std::max(std::abs(x * box.low[i]), std::abs(x * box.high[i]));
      }
      if (high + kRounding * size < at_low_[k] || low - kRounding * size > at_high_[k]) {
        return false;
      }
    }
    return true;
  }

 private:
  static constexpr double kRounding = 0x1p-40;

  Box own_;
  std::array<Vec3d, 3> across_;
  std::array<double, 3> at_low_{}, at_high_{};
};

bool certainly_misses(const Vec3d& from, const Vec3d& to, const Vec3d& a, const Vec3d& b,
                      const Vec3d& c) {
  const int side = orientation(a, b, c, from);
  if (side != 0 && side == orientation(a, b, c, to)) return true;
  const std::array<int, 3> turns = {orientation(from, to, a, b), orientation(from, to, b, c),
                                    orientation(from, to, c, a)};
  const auto any = [&](int sign) {
    return std::find(turns.begin(), turns.end(), sign) != turns.end();
  };
  return any(1) && any(-1);
}

}  // namespace

SoupRays::SoupRays(const TriangleSoup& soup, std::span<const std::int32_t> winding)
    : soup_(soup), winding_(winding), tree_(boxes_of(soup)) {}

std::int32_t SoupRays::winding_at(const Vec3d& point) const {
  const RayStart start = RayStart::at(point);
  std::int32_t sum = 0;
  internal::visit_column(tree_, start.corner, [&](std::uint32_t t) {
    const auto& c = soup_.triangles[t];
    sum += winding_[t] * internal::passed_upward(soup_.points[c[0]], soup_.points[c[1]],
                                                 soup_.points[c[2]], start);
  });
  return sum;
}

bool SoupRays::sees(const Vec3d& from, const Vec3d& to) const {
  const SegmentReach reach(from, to);
  bool free = true;
  tree_.visit([&](const Box& box) { return free && reach(box); },
              [&](std::uint32_t t) {
                const auto& c = soup_.triangles[t];
                free = free && certainly_misses(from, to, soup_.points[c[0]], soup_.points[c[1]],
                                                soup_.points[c[2]]);
              });
  return free;
}

std::vector<std::vector<std::uint32_t>> triangles_above(const TriangleSoup& soup,
                                                        std::span<const CornerRay> rays) {
  const std::vector<RayStart> starts = starts_of(soup, rays);
  const BoxTree tree(boxes_of(starts));
  const auto pass = [&](std::size_t first, std::size_t last) {
    std::vector<Passage> passages;
    for (std::size_t i = first; i < last; ++i) {
      const auto t = static_cast<std::uint32_t>(i);
      const auto& c = soup.triangles[t];
      const Vec3d &p = soup.points[c[0]], &q = soup.points[c[1]], &r = soup.points[c[2]];
      visit_below(tree, internal::box_of(soup, t), [&](std::uint32_t ray) {
        const RayStart& start = starts[ray];
        if (t == rays[ray].triangle || !internal::may_reach(start.corner, p, q, r)) return;
        if (internal::passed_upward(p, q, r, start) != 0) passages.push_back({ray, t});
      });
    }
    return passages;
  };
  std::vector<std::vector<std::uint32_t>> above(rays.size());
  parallel_reduce(soup.triangles.size(), kTrianglesPerTask, pass,
                  [&](std::vector<Passage>& /*all*/, const std::vector<Passage>& passages) {
                    for (const Passage& p : passages) above[p.ray].push_back(p.triangle);
                  });
  return above;
}

}  // namespace meshrepair
