#include "seal_patch.h"

#include <algorithm>
#include <map>
#include <utility>

#include <Eigen/Geometry>

#include <base/disjoint_sets.h>
#include <mesh/edge_table.h>

namespace meshrepair::internal {
namespace {

constexpr int kRounds = 12;  // of smoothing

// How far a ring goes on from the border, in steps: the first of these that is behind a wall.
constexpr std::array<double, 4> kRing = {2.5, 3.5, 5, 8};

// An edge that one triangle has, and the triangle's corner across it.
struct BorderEdge {
  std::uint32_t from, to, across;
};

class PatchMaker {
 public:
  PatchMaker(const SpaceGrid& grid, const SoupRays& rays) : grid_(grid), rays_(rays) {}

  SealPatch run(const std::vector<BallReach::Face>& faces) {
    for (const BallReach::Face& face : faces) add_face(face);
    find_border();
    smooth();
    count_pieces();
    add_ring();
    return {std::move(soup_), pieces_};
  }

 private:
  std::uint32_t point_at(const CubePlace& place) {
    const auto [found, is_new] =
        number_.try_emplace(place, static_cast<std::uint32_t>(soup_.points.size()));
    if (is_new) soup_.points.push_back(grid_.corner(place));
    return found->second;
  }

  // Two triangles; it does not matter which way they are turned.
  void add_face(const BallReach::Face& face) {
    const CubePlace a = grid_.place_of(face.outer), b = grid_.place_of(face.inner);
    std::size_t axis = 0;
    while (a[axis] == b[axis]) ++axis;
    CubePlace low = a;
    low[axis] = std::max(a[axis], b[axis]);
    std::array<std::uint32_t, 4> corners{};
    for (std::size_t i = 0; i < 4; ++i) {
      CubePlace at = low;
      at[(axis + 1) % 3] += i == 1 || i == 2 ? 1 : 0;
      at[(axis + 2) % 3] += i >= 2 ? 1 : 0;
      corners[i] = point_at(at);
    }
    if (a[axis] < b[axis]) std::swap(corners[1], corners[3]);
    soup_.triangles.push_back({corners[0], corners[1], corners[2]});
    soup_.triangles.push_back({corners[0], corners[2], corners[3]});
  }

  void find_border() {
    is_border_.assign(soup_.points.size(), 0);
    EdgeTable(soup_.triangles).for_each_edge([&](std::span<const std::uint32_t> sides) {
      if (sides.size() != 1) return;
      const auto& t = soup_.triangles[sides[0] / 3];
      const std::size_t k = sides[0] % 3;
      border_.push_back({t[k], t[(k + 1) % 3], t[(k + 2) % 3]});
      is_border_[t[k]] = is_border_[t[(k + 1) % 3]] = 1;
    });
  }

  // Each point goes to the middle of its neighbours, those of the border to that of their own.
  void smooth() {
    for (int round = 0; round < kRounds; ++round) {
      std::vector<Vec3d> sum(soup_.points.size(), Vec3d::Zero());
      std::vector<double> count(soup_.points.size(), 0);
      const auto join = [&](std::uint32_t to, std::uint32_t from) {
        sum[to] += soup_.points[from];
        count[to] += 1;
      };
      for (const auto& t : soup_.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
          if (is_border_[t[k]] != 0) continue;
          join(t[k], t[(k + 1) % 3]);
          join(t[k], t[(k + 2) % 3]);
        }
      }
      for (std::size_t p = 0; p < sum.size(); ++p) {
        if (count[p] > 0) soup_.points[p] = 0.5 * (soup_.points[p] + sum[p] / count[p]);
      }
    }
  }

  void count_pieces() {
    DisjointSets sets(soup_.points.size());
    for (const auto& t : soup_.triangles) {
      sets.join(t[0], t[1]);
      sets.join(t[1], t[2]);
    }
    for (std::uint32_t p = 0; p < soup_.points.size(); ++p) pieces_ += sets.root(p) == p ? 1 : 0;
  }

  void add_ring() {
    std::vector<Vec3d> away(soup_.points.size(), Vec3d::Zero());
    for (const BorderEdge& edge : border_) {
      const Vec3d &from = soup_.points[edge.from], &to = soup_.points[edge.to];
      const Vec3d along = (to - from).normalized();
      const Vec3d back = from - soup_.points[edge.across];
      const Vec3d out = (back - back.dot(along) * along).normalized();
      away[edge.from] += out;
      away[edge.to] += out;
    }
    std::vector<std::uint32_t> ring(soup_.points.size(), kNone);
    for (const BorderEdge& edge : border_) {
      for (const std::uint32_t p : {edge.from, edge.to}) {
        if (ring[p] != kNone) continue;
        ring[p] = static_cast<std::uint32_t>(soup_.points.size());
        soup_.points.push_back(behind_wall(soup_.points[p], away[p].normalized()));
      }
    }
    for (const BorderEdge& edge : border_) {
      soup_.triangles.push_back({edge.to, edge.from, ring[edge.from]});
      soup_.triangles.push_back({edge.to, ring[edge.from], ring[edge.to]});
    }
  }

  [[nodiscard]] Vec3d behind_wall(const Vec3d& from, const Vec3d& direction) const {
    Vec3d to = from;
    for (const double steps : kRing) {
      to = from + steps * grid_.step() * direction;
      if (!rays_.sees(from, to)) return to;
    }
    return from + kRing.front() * grid_.step() * direction;
  }

  const SpaceGrid& grid_;
  const SoupRays& rays_;
  TriangleSoup soup_;
  std::map<CubePlace, std::uint32_t> number_;
  std::vector<BorderEdge> border_;
  std::vector<char> is_border_;
  std::size_t pieces_ = 0;
};

}  // namespace

SealPatch make_seal_patch(const SpaceGrid& grid, const SoupRays& rays,
                          const std::vector<BallReach::Face>& faces) {
  return PatchMaker(grid, rays).run(faces);
}

}  // namespace meshrepair::internal
