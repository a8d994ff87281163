// SPDX-License-Identifier: MIT
// The axes are those of inertia of the corners, and two boxes are compared by the 15 directions
// that can separate them, as in Gottschalk, Lin and Manocha, OBBTree: a hierarchical structure for
// rapid interference detection (1996).
#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Eigenvalues>

#include <base/parallel.h>
#include <check/internal/oriented_boxes.h>

namespace meshrepair::internal {
namespace {

constexpr std::size_t kPointsPerTask = 4096;
constexpr std::size_t kNodesPerTask = 256;
// Of the corners, which tell the axes.
constexpr std::size_t kMostSamples = 64;
// Of the size of the whole, which is below 2: beyond what rounding does to axes, differences and
// sums of a few products.
constexpr double kBoxMargin = 0x1p-42;
// For the same reason: to the share of one axis in another, and to a length along what is square to
// two, which nearly vanishes where these are nearly parallel.
constexpr double kAxisMargin = 0x1p-46;

// Moves and scales points so that they lie around the origin, and no product overflows: differences
// are rounded once.
class ToUnitSize {
 public:
  explicit ToUnitSize(const Box& whole) {
    double size = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      half_centre_[axis] = 0.25 * whole.low[k] + 0.25 * whole.high[k];
      size = std::max(size, 0.25 * whole.high[k] - 0.25 * whole.low[k]);
    }
    (void)std::frexp(size, &exponent_);
  }

  [[nodiscard]] Vec3d operator()(const Vec3d& point) const {
    Vec3d moved = 0.5 * point - half_centre_;
    for (double& x : moved) x = std::ldexp(x, -exponent_);
    return moved;
  }
  // The length that becomes 1.
  [[nodiscard]] double unit() const { return std::ldexp(2, exponent_); }

 private:
  Vec3d half_centre_;
  int exponent_ = 0;
};

// The axes, last one first, square to each other; those of space where that fails.
Eigen::Matrix3d squared(const Eigen::Matrix3d& axes) {
  Eigen::Matrix3d frame;
  frame.col(2) = axes.col(2).normalized();
  frame.col(1) = (axes.col(1) - axes.col(1).dot(frame.col(2)) * frame.col(2)).normalized();
  frame.col(0) = frame.col(1).cross(frame.col(2));
  const Eigen::Matrix3d error = frame.transpose() * frame - Eigen::Matrix3d::Identity();
  const bool is_square = error.cwiseAbs().maxCoeff() < kAxisMargin;  // not if not a number
  return is_square ? frame : Eigen::Matrix3d::Identity().eval();
}

}  // namespace

OrientedBoxes::OrientedBoxes(const BoxTree& tree, std::vector<Vec3d> corners) {
  if (corners.empty()) return;
  const ToUnitSize to_unit_size(tree.nodes()[0].box);
  unit_ = to_unit_size.unit();
  parallel_tasks(corners.size(), kPointsPerTask,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t p = first; p < last; ++p) corners[p] = to_unit_size(corners[p]);
                 });
  boxes_.resize(tree.nodes().size());
  parallel_tasks(
      boxes_.size(), kNodesPerTask, [&](std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n) {
          const BoxNode& node = tree.nodes()[n];
          boxes_[n] = around(
              std::span(corners).subspan(std::size_t{3} * node.first, std::size_t{3} * node.count));
        }
      });
}

OrientedBoxes::OrientedBox OrientedBoxes::around(std::span<const Vec3d> points) {
  const std::size_t step = points.size() / kMostSamples + 1;
  Vec3d mean = Vec3d::Zero();
  for (std::size_t i = 0; i < points.size(); i += step) mean += points[i];
  const std::size_t samples = (points.size() + step - 1) / step;
  mean /= static_cast<double>(samples);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < points.size(); i += step) {
    spread += (points[i] - mean) * (points[i] - mean).transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> inertia;
  inertia.computeDirect(spread);
  OrientedBox box;
  box.axes = squared(inertia.eigenvectors());
  Vec3d low = box.axes.transpose() * (points[0] - mean), high = low;
  for (const Vec3d& p : points) {
    const Vec3d at = box.axes.transpose() * (p - mean);
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  box.centre = mean + box.axes * (0.5 * (low + high));
  box.half = (0.5 * (high - low)).array() + kBoxMargin;
  return box;
}

bool OrientedBoxes::are_within(double distance, std::uint32_t node_a, std::uint32_t node_b) const {
  const double apart = distance / unit_ + kAxisMargin;
  const OrientedBox &a = boxes_[node_a], &b = boxes_[node_b];
  const Vec3d between = b.centre - a.centre;
  const Vec3d t = a.axes.transpose() * between;
  const Eigen::Matrix3d turn = a.axes.transpose() * b.axes;
  const Eigen::Matrix3d size = turn.cwiseAbs().array() + kAxisMargin;
  const Vec3d reach_a = (a.half + size * b.half).array() + apart;
  if ((t.cwiseAbs().array() > reach_a.array()).any()) return false;
  const Vec3d along_b = b.axes.transpose() * between;
  const Vec3d reach_b = (b.half + size.transpose() * a.half).array() + apart;
  if ((along_b.cwiseAbs().array() > reach_b.array()).any()) return false;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Eigen::Index i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (Eigen::Index j = 0; j < 3; ++j) {
      const Eigen::Index j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double reach = a.half[i1] * size(i2, j) + a.half[i2] * size(i1, j) +
                           b.half[j1] * size(i, j2) + b.half[j2] * size(i, j1) + apart;
      if (std::abs(t[i2] * turn(i1, j) - t[i1] * turn(i2, j)) > reach) return false;
    }
  }
  return true;
}

}  // namespace meshrepair::internal
