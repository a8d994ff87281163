// SPDX-License-Identifier: MIT
#include "point_index.h"

#include <algorithm>
#include <limits>
#include <nanoflann.hpp>

#include <Eigen/Geometry>

#include <base/parallel.h>

namespace meshrepair {
namespace {

// 21 bits of each coordinate in its share of the box, taken by turns: the points along a Z-shaped
// curve (G. M. Morton, 1966).
std::uint64_t place_on_curve(const Vec3d& share) {
  constexpr double kSteps = 0x1p21 - 1;
  std::uint64_t place = 0;
  for (Eigen::Index k = 0; k < 3; ++k) {
    auto bits = static_cast<std::uint64_t>(share[k] * kSteps);
    bits = (bits | bits << 32) & 0x1F00000000FFFFu;
    bits = (bits | bits << 16) & 0x1F0000FF0000FFu;
    bits = (bits | bits << 8) & 0x100F00F00F00F00Fu;
    bits = (bits | bits << 4) & 0x10C30C30C30C30C3u;
    bits = (bits | bits << 2) & 0x1249249249249249u;
    place |= bits << k;
  }
  return place;
}

Eigen::AlignedBox3d box_of(const std::vector<Vec3d>& points) {
  Eigen::AlignedBox3d box;
  for (const Vec3d& p : points) box.extend(p);
  return box;
}

std::vector<std::uint32_t> order_along_curve(const std::vector<Vec3d>& points) {
  struct Entry {
    std::uint64_t place;
    std::uint32_t point;
  };
  const Eigen::AlignedBox3d box = box_of(points);
  // A box without extent has one place for all.
  const Vec3d extent = box.sizes().cwiseMax(std::numeric_limits<double>::min());
  std::vector<Entry> entries(points.size());
  parallel_for(points.size(), [&](std::size_t p) {
    const Vec3d share = (points[p] - box.min()).cwiseQuotient(extent);
    entries[p] = {place_on_curve(share), static_cast<std::uint32_t>(p)};
  });
  parallel_sort(entries.begin(), entries.end(),
                [](const Entry& a, const Entry& b) { return a.place < b.place; });
  std::vector<std::uint32_t> order;
  order.reserve(entries.size());
  for (const Entry& entry : entries) order.push_back(entry.point);
  return order;
}

// The points as nanoflann wants to see them, along the curve.
struct Points {
  explicit Points(const std::vector<Vec3d>& all) : order(order_along_curve(all)) {
    points.reserve(all.size());
    for (const std::uint32_t p : order) points.push_back(all[p]);
  }

  std::vector<std::uint32_t> order;  // which of all each is
  std::vector<Vec3d> points;

  // NOLINTBEGIN(readability-identifier-naming): names that the library prescribes
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] double kdtree_get_pt(std::size_t point, std::size_t axis) const {
    return points[point][static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }
  // NOLINTEND(readability-identifier-naming)
};

// The nearest so far, kept in order.
class NearestSet {
 public:
  using DistanceType = double;

  NearestSet(std::span<const std::uint32_t> order, std::span<Neighbour> room)
      : order_(order), room_(room) {}

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool full() const { return size_ == room_.size(); }
  [[nodiscard]] double worstDist() const {  // NOLINT(readability-identifier-naming)
    return full() ? room_.back().distance : std::numeric_limits<double>::max();
  }
  bool addPoint(double distance, std::uint32_t point) {  // NOLINT(readability-identifier-naming)
    const Neighbour added = {distance, order_[point]};
    if (full() && !(added < room_.back())) return true;
    std::size_t at = full() ? size_ - 1 : size_++;
    for (; at > 0 && added < room_[at - 1]; --at) room_[at] = room_[at - 1];
    room_[at] = added;
    return true;
  }

 private:
  std::span<const std::uint32_t> order_;
  std::span<Neighbour> room_;
  std::size_t size_ = 0;
};

// All that are nearer than this.
class NearSet {
 public:
  using DistanceType = double;

  NearSet(std::span<const std::uint32_t> order, double within, std::vector<Neighbour>& found)
      : order_(order), within_(within), found_(found) {}

  [[nodiscard]] std::size_t size() const { return found_.size(); }
  [[nodiscard]] bool full() const { return true; }
  [[nodiscard]] double worstDist() const {  // NOLINT(readability-identifier-naming)
    return within_;
  }
  bool addPoint(double distance, std::uint32_t point) {  // NOLINT(readability-identifier-naming)
    found_.push_back({distance, order_[point]});
    return true;
  }

 private:
  std::span<const std::uint32_t> order_;
  double within_;
  std::vector<Neighbour>& found_;
};

using Metric = nanoflann::L2_Simple_Adaptor<double, Points, double, std::uint32_t>;
using KdTree = nanoflann::KDTreeSingleIndexAdaptor<Metric, Points, 3, std::uint32_t>;

}  // namespace

struct PointIndex::Tree {
  explicit Tree(const std::vector<Vec3d>& all) : points(all), index(3, points) {
    index.buildIndex();
  }

  Points points;
  KdTree index;
};

PointIndex::PointIndex(const std::vector<Vec3d>& points) : tree_(std::make_unique<Tree>(points)) {}

PointIndex::~PointIndex() = default;

std::size_t PointIndex::nearest(const Vec3d& at, std::span<Neighbour> out) const {
  if (out.empty() || tree_->points.points.empty()) return 0;
  NearestSet found(tree_->points.order, out);
  tree_->index.findNeighbors(found, at.data(), nanoflann::SearchParams());
  return found.size();
}

std::size_t PointIndex::nearest(const Vec3d& at, double within, std::vector<Neighbour>& scratch,
                                std::span<Neighbour> out) const {
  scratch.clear();
  NearSet near(tree_->points.order, within, scratch);
  tree_->index.findNeighbors(near, at.data(), nanoflann::SearchParams());
  if (scratch.size() < out.size()) return nearest(at, out);
  const auto end = scratch.begin() + static_cast<std::ptrdiff_t>(out.size());
  std::nth_element(scratch.begin(), end, scratch.end());
  std::sort(scratch.begin(), end);
  std::copy(scratch.begin(), end, out.begin());
  return out.size();
}

std::span<const std::uint32_t> PointIndex::order() const { return tree_->points.order; }

}  // namespace meshrepair
