#include "point_index.h"

#include <limits>
#include <nanoflann.hpp>

namespace meshrepair {
namespace {

// The points as nanoflann wants to see them.
struct Points {
  const std::vector<Vec3d>& points;

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

  explicit NearestSet(std::span<Neighbour> room) : room_(room) {}

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool full() const { return size_ == room_.size(); }
  [[nodiscard]] double worstDist() const {  // NOLINT(readability-identifier-naming)
    return full() ? room_.back().distance : std::numeric_limits<double>::max();
  }
  bool addPoint(double distance, std::uint32_t point) {  // NOLINT(readability-identifier-naming)
    const Neighbour added = {distance, point};
    if (full() && !(added < room_.back())) return true;
    std::size_t at = full() ? size_ - 1 : size_++;
    for (; at > 0 && added < room_[at - 1]; --at) room_[at] = room_[at - 1];
    room_[at] = added;
    return true;
  }

 private:
  std::span<Neighbour> room_;
  std::size_t size_ = 0;
};

using Metric = nanoflann::L2_Simple_Adaptor<double, Points, double, std::uint32_t>;
using KdTree = nanoflann::KDTreeSingleIndexAdaptor<Metric, Points, 3, std::uint32_t>;

}  // namespace

struct PointIndex::Tree {
  explicit Tree(const std::vector<Vec3d>& all) : points{all}, index(3, points) {
    index.buildIndex();
  }

  Points points;
  KdTree index;
};

PointIndex::PointIndex(const std::vector<Vec3d>& points) : tree_(std::make_unique<Tree>(points)) {}

PointIndex::~PointIndex() = default;

std::size_t PointIndex::nearest(const Vec3d& at, std::span<Neighbour> out) const {
  if (out.empty() || tree_->points.points.empty()) return 0;
  NearestSet found(out);
  tree_->index.findNeighbors(found, at.data(), nanoflann::SearchParams());
  return found.size();
}

}  // namespace meshrepair
