#include "settle_points.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <mesh/weld_points.h>

namespace meshrepair::internal {
namespace {

class Settler {
 public:
  Settler(Surface& surface, const Grid& grid, KnownIntersections& known)
      : surface_(surface), grid_(grid), known_(known) {}

  std::size_t run() {
    const TriangleSoup& mesh = surface_.mesh;
    SelfIntersections found = known_.find(mesh);
    if (found.pairs.empty()) return 0;
    places_ = find_places(mesh.points);
    moves_.assign(places_.place.size(), 0);
    while (settle(found)) found = known_.find(mesh);
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

  Surface& surface_;
  const Grid& grid_;
  KnownIntersections& known_;
  PointPlaces places_;
  std::vector<char> moves_;  // of each place
  std::size_t moved_ = 0;
};

}  // namespace

std::size_t settle_input_points(Surface& surface, const Grid& grid, KnownIntersections& known) {
  return Settler(surface, grid, known).run();
}

}  // namespace meshrepair::internal
