#include "neighbourhoods.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "point_blocks.h"

namespace meshrepair {

namespace {

// Fewer are found as fast without knowing how far away they are.
constexpr std::size_t kMany = 32;

// More than rounding adds to a distance.
constexpr double kRounding = 1 + 1e-9;

// Looks up one point after the other. As many as are near one are near the next one, too, if
// the way to it is added.
class NearestFinder {
 public:
  NearestFinder(const PointIndex& index, std::size_t count) : index_(index), found_(count) {}

  std::span<const Neighbour> find(const Vec3d& at) {
    if (found_.size() < kMany) {
      index_.nearest(at, found_);
      return found_;
    }
    const double within = kRounding * (farthest_ + (at - last_).norm());
    if (farthest_ > 0) index_.nearest(at, within * within, scratch_, found_);
    if (!(farthest_ > 0)) index_.nearest(at, found_);
    farthest_ = std::sqrt(found_.back().distance);
    last_ = at;
    return found_;
  }

 private:
  const PointIndex& index_;
  std::vector<Neighbour> found_, scratch_;
  Vec3d last_ = Vec3d::Zero();
  double farthest_ = 0;  // from the last point; 0: there was none
};

}  // namespace

Neighbourhoods find_neighbourhoods(const PointIndex& index, const std::vector<Vec3d>& points,
                                   std::size_t count, ProgressObserver* progress) {
  Neighbourhoods result;
  if (points.empty()) return result;
  result.per_point = std::min(count, points.size() - 1);
  result.points.resize(points.size() * result.per_point);
  for_blocks(points.size(), progress, [&](std::size_t, std::size_t first, std::size_t last) {
    NearestFinder finder(index, result.per_point + 1);
    for (std::size_t i = first; i < last; ++i) {
      const std::uint32_t p = index.order()[i];
      const std::span<const Neighbour> found = finder.find(points[p]);
      // Where points coincide, the point itself need not be among those that were found.
      std::uint32_t* out = result.points.data() + std::size_t{p} * result.per_point;
      std::uint32_t* const end = out + result.per_point;
      for (const Neighbour& neighbour : found) {
        if (neighbour.point != p && out != end) *out++ = neighbour.point;
      }
    }
  });
  return result;
}

}  // namespace meshrepair
