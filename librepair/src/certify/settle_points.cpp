#include "settle_points.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <check/self_intersections.h>
#include <mesh/weld_points.h>

namespace meshrepair::internal {
namespace {

constexpr std::size_t kPairsToSettle = 1'000'000;

class Settler {
 public:
  Settler(Surface& surface, const Grid& grid, ProgressObserver* progress)
      : surface_(surface), grid_(grid) {
    options_.most_pairs = kPairsToSettle;
    options_.progress = progress;
  }

  std::size_t run() {
    const TriangleSoup& mesh = surface_.mesh;
    SelfIntersections found = self_intersections(mesh, options_);
    if (found.pairs.empty()) return 0;
    places_ = find_places(mesh.points);
    moves_.assign(places_.place.size(), 0);
    while (settle(found)) {
      const bool all_known = found.count == found.pairs.size();
      found = all_known ? self_intersections(mesh, to_test(found), options_)
                        : self_intersections(mesh, options_);
    }
    return moved_;
  }

 private:
  // False if no point had to move.
  bool settle(const SelfIntersections& found) {
    std::fill(moves_.begin(), moves_.end(), 0);
    for (const auto& pair : found.pairs) {
      for (const std::uint32_t t : pair) {
        for (const std::uint32_t p : surface_.mesh.triangles[t]) moves_[places_.place[p]] = 1;
      }
    }
    const std::size_t before = moved_;
    for (std::size_t p = 0; p < surface_.mesh.points.size(); ++p) {
      if (moves_[places_.place[p]] != 0 && surface_.input_point[p] != 0) settle_point(p);
    }
    return moved_ > before;
  }

  void settle_point(std::size_t p) {
    Vec3d& position = surface_.mesh.points[p];
    const Vec3d on_grid = as_vector(grid_.to_grid(position));
    const Vec3d settled = grid_.from_grid({on_grid.x(), on_grid.y(), on_grid.z()});
    if (settled == position) return;
    position = settled;
    surface_.input_point[p] = 0;
    ++moved_;
  }

  // What was found, and all triangles of the points that have moved just now.
  [[nodiscard]] std::vector<std::uint32_t> to_test(const SelfIntersections& found) const {
    std::vector<std::uint32_t> triangles;
    for (const auto& pair : found.pairs) {
      triangles.insert(triangles.end(), pair.begin(), pair.end());
    }
    for (std::uint32_t t = 0; t < surface_.mesh.triangles.size(); ++t) {
      for (const std::uint32_t p : surface_.mesh.triangles[t]) {
        if (moves_[places_.place[p]] == 0) continue;
        triangles.push_back(t);
        break;
      }
    }
    return triangles;
  }

  Surface& surface_;
  const Grid& grid_;
  SelfIntersectionOptions options_;
  PointPlaces places_;
  std::vector<char> moves_;  // of each place
  std::size_t moved_ = 0;
};

}  // namespace

std::size_t settle_input_points(Surface& surface, const Grid& grid, ProgressObserver* progress) {
  return Settler(surface, grid, progress).run();
}

}  // namespace meshrepair::internal
