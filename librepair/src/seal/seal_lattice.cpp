// SPDX-License-Identifier: MIT
#include "seal_lattice.h"

#include <algorithm>
#include <array>
#include <utility>

namespace meshrepair::internal {
namespace {

// Of a cube's side, and of what the nearest triangle is away.
constexpr double kMarkerOfStep = 0.05, kMarkerOfClearance = 0.25;

// Of a tetrahedron. Along no axis is a corner above the diagonal of a cube's face: rays from its
// corners tell where it lies, unless they meet an edge.
const std::array<Vec3d, 4> kMarkerCorners = {Vec3d(1, 0.2, -0.4), Vec3d(-0.4, 1, 0.2),
                                             Vec3d(0.2, -0.4, 1), Vec3d(-0.9, -0.5, -0.1)};

std::uint64_t key_of(const CubePlace& place) {
  constexpr unsigned kBits = 21;  // a grid has fewer cubes than 2^21 to a side
  std::uint64_t key = 0;
  for (const std::int32_t x : place) key = key << kBits | static_cast<std::uint32_t>(x);
  return key;
}

class LatticeMaker {
 public:
  LatticeMaker(const SpaceGrid& grid, const BallReach& reach)
      : grid_(grid), reach_(reach), state_(grid.cubes(), kElsewhere) {}

  SealLattice run(const std::vector<BallReach::Face>& closed, std::int32_t around) {
    for (const BallReach::Face& face : closed) {
      choose_around(face.outer, around);
      choose_around(face.inner, around);
    }
    for (const std::uint32_t cube : chosen_) add_faces(cube);
    index_points();
    lattice_.first_marker = lattice_.soup.triangles.size();
    for (const std::uint32_t cube : chosen_) mark_before(cube);
    for (const BallReach::Face& face : closed) mark(face.inner, true);
    for (const std::uint32_t cube : chosen_) mark_behind(cube);
    return std::move(lattice_);
  }

 private:
  static constexpr char kElsewhere = 0, kChosen = 1, kMarked = 2;

  void choose_around(std::uint32_t cube, std::int32_t around) {
    const CubePlace at = grid_.place_of(cube);
    CubePlace low = at;
    for (low[2] = at[2] - around; low[2] <= at[2] + around; ++low[2]) {
      for (low[1] = at[1] - around; low[1] <= at[1] + around; ++low[1]) {
        for (low[0] = at[0] - around; low[0] <= at[0] + around; ++low[0]) {
          const std::uint32_t node = grid_.node_at(low);
          if (node == kNone || !grid_.is_cube(node) || state_[node] == kChosen) continue;
          state_[node] = kChosen;
          chosen_.push_back(node);
        }
      }
    }
  }

  // Those that two chosen cubes have in common come from the one with the higher place.
  void add_faces(std::uint32_t cube) {
    const CubePlace at = grid_.place_of(cube);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const std::int32_t side : {0, 1}) {
        CubePlace beside = at;
        beside[axis] += side == 0 ? -1 : 1;
        const std::uint32_t next = grid_.node_at(beside);
        const bool is_shared = next != kNone && grid_.is_cube(next) && state_[next] == kChosen;
        if (side == 1 && is_shared) continue;
        CubePlace low = at;
        low[axis] += side;
        add_face(low, axis);
      }
    }
  }

  void add_face(const CubePlace& low, std::size_t axis) {
    for (std::size_t i = 0; i < 4; ++i) {
      CubePlace at = low;
      at[(axis + 1) % 3] += i == 1 || i == 2 ? 1 : 0;
      at[(axis + 2) % 3] += i >= 2 ? 1 : 0;
      corners_.push_back(at);
    }
  }

  void index_points() {
    std::vector<std::pair<std::uint64_t, CubePlace>> places;
    places.reserve(corners_.size());
    for (const CubePlace& at : corners_) places.emplace_back(key_of(at), at);
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    for (const auto& [key, at] : places) lattice_.soup.points.push_back(grid_.corner(at));
    const auto number = [&](const CubePlace& at) {
      const auto found = std::lower_bound(places.begin(), places.end(), std::pair(key_of(at), at)) -
                         places.begin();
      return static_cast<std::uint32_t>(found);
    };
    for (std::size_t i = 0; i < corners_.size(); i += 4) {
      const std::array<std::uint32_t, 4> c = {number(corners_[i]), number(corners_[i + 1]),
                                              number(corners_[i + 2]), number(corners_[i + 3])};
      lattice_.soup.triangles.push_back({c[0], c[1], c[2]});
      lattice_.soup.triangles.push_back({c[0], c[2], c[3]});
    }
  }

  // Where the ball comes to the edge of what it does not come to.
  void mark_before(std::uint32_t cube) {
    if (!reach_.is_reached(cube)) return;
    bool is_last = false;
    grid_.visit_neighbours(cube, [&](std::uint32_t next) {
      is_last = is_last || (grid_.is_cube(next) && !reach_.is_reached(next));
    });
    if (is_last) mark(cube, false);
  }

  // What lies behind the lattice.
  void mark_behind(std::uint32_t cube) {
    if (!reach_.is_behind(cube)) return;
    grid_.visit_neighbours(cube, [&](std::uint32_t next) {
      if (!grid_.is_cube(next) || state_[next] != kElsewhere) return;
      if (reach_.is_behind(next) && reach_.is_free(cube, next)) mark(next, true);
    });
  }

  void mark(std::uint32_t cube, bool is_behind) {
    if (!is_behind || state_[cube] != kMarked) {
      const double size =
          std::min(kMarkerOfStep * grid_.step(), kMarkerOfClearance * grid_.clearance(cube));
      add_tetrahedron(grid_.centre(cube), size);
      lattice_.is_behind.push_back(is_behind ? 1 : 0);
    }
    state_[cube] = kMarked;
  }

  void add_tetrahedron(const Vec3d& centre, double size) {
    const auto first = static_cast<std::uint32_t>(lattice_.soup.points.size());
    for (const Vec3d& corner : kMarkerCorners) {
      lattice_.soup.points.push_back(centre + size / 2 * corner);
    }
    for (std::uint32_t left_out = 0; left_out < 4; ++left_out) {
      lattice_.soup.triangles.push_back(
          {first + (left_out + 1) % 4, first + (left_out + 2) % 4, first + (left_out + 3) % 4});
    }
  }

  const SpaceGrid& grid_;
  const BallReach& reach_;
  std::vector<char> state_;  // of each cube
  std::vector<std::uint32_t> chosen_;
  std::vector<CubePlace> corners_;  // four of each face
  SealLattice lattice_;
};

}  // namespace

SealLattice make_seal_lattice(const SpaceGrid& grid, const BallReach& reach,
                              const std::vector<BallReach::Face>& closed, std::int32_t around) {
  return LatticeMaker(grid, reach).run(closed, around);
}

}  // namespace meshrepair::internal
