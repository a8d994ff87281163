// SPDX-License-Identifier: MIT
// Which points are near a place: a k-d tree over points, to be asked from many threads at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <mesh/soup.h>

namespace meshrepair {

struct Neighbour {
  double distance = 0;  // squared
  std::uint32_t point = 0;

  // Nearer first, then by number.
  bool operator<(const Neighbour& other) const {
    return distance != other.distance ? distance < other.distance : point < other.point;
  }
};

class PointIndex {
 public:
  // The points are finite and small enough for their squared distances. It has a copy of them, in
  // an order in which near ones lie together: looking up does not wait for memory then.
  explicit PointIndex(const std::vector<Vec3d>& points);
  PointIndex(const PointIndex&) = delete;
  PointIndex& operator=(const PointIndex&) = delete;
  ~PointIndex();

  // Fills the front of `out` with the points nearest to `at`, in order, and returns how many there
  // are: as many as `out` has room for, or all.
  std::size_t nearest(const Vec3d& at, std::span<Neighbour> out) const;

  // The same; faster for many where `within`, a squared distance, is little more than that of the
  // last one. Where it is less, it takes longer.
  std::size_t nearest(const Vec3d& at, double within, std::vector<Neighbour>& scratch,
                      std::span<Neighbour> out) const;

  // All points, those near to each other one after the other: to look up many, best in this order.
  [[nodiscard]] std::span<const std::uint32_t> order() const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace meshrepair
