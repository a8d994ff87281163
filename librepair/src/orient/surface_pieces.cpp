// SPDX-License-Identifier: MIT
#include "surface_pieces.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include <base/parallel.h>
#include <base/roots.h>
#include <base/trivial_vector.h>
#include <mesh/internal/triangle_measures.h>

#include "turn_sets.h"

namespace meshrepair::internal {
namespace {

// A surface is nearly closed when what would close it has at most this share of its own area: a
// cup twice as high as wide has its rim at 0.11, a hemisphere at 0.5, a flat sheet at 1.
constexpr double kHoleShare = 0.25;

// Across an edge with exactly two triangles: the neighbour, and whether they agree as they are.
struct Neighbour {
  std::uint32_t triangle = ~std::uint32_t{0};
  bool agrees = true;
};

// An edge with exactly two triangles, of those in a piece that cannot be oriented.
struct Fold {
  double fold;
  std::uint32_t a, b;
  bool agrees;
};

using Neighbours = TrivialVector<std::array<Neighbour, 3>>;

constexpr std::size_t kEdgesPerTask = 16384;
constexpr std::size_t kSumsPerTask = 8192;

Neighbours find_neighbours(std::span<const IndexTriangle> triangles, const EdgeTable& table) {
  Neighbours neighbours;
  neighbours.resize_for_overwrite(triangles.size());  // each side is one of some edge
  parallel_tasks(table.edges(), kEdgesPerTask,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t edge = first; edge < last; ++edge) {
                     const std::span<const std::uint32_t> sides = table.sides(edge);
                     for (const std::uint32_t s : sides) neighbours[s / 3][s % 3] = Neighbour();
                     if (sides.size() != 2) continue;
                     const std::uint32_t a = sides[0], b = sides[1];
                     const bool agrees = side_start(triangles, a) != side_start(triangles, b);
                     neighbours[a / 3][a % 3] = {b / 3, agrees};
                     neighbours[b / 3][b % 3] = {a / 3, agrees};
                   }
                 });
  return neighbours;
}

Plane plane_of_corners(const CleanSoup& soup, TriangleId t) {
  const auto& c = soup.triangles[t].corners;
  return plane_through(soup.grid_points[c[0]], soup.grid_points[c[1]], soup.grid_points[c[2]]);
}

// The orientation of a triangle that closes a hole is nobody's word.
bool says_something(const Triangle& triangle) {
  return triangle.winding != 0 && triangle.source != Triangle::kNoSource;
}

SurfaceSum sum_of(const CleanSoup& soup, TriangleId t) {
  SurfaceSum sum;
  const Triangle& triangle = soup.triangles[t];
  const Plane plane = plane_of_corners(soup, t);
  sum.area =
      stable_length({static_cast<double>(plane.normal[0]), static_cast<double>(plane.normal[1]),
                     static_cast<double>(plane.normal[2])});
  if (says_something(triangle)) sum.kept = sum.area;
  sum.six_volumes = -plane.offset;
  for (std::size_t k = 0; k < 3; ++k) sum.normal[k] = plane.normal[k];
  for (const PointId p : triangle.corners) {
    const GridPoint& at = soup.grid_points[p];
    sum.low = {std::min(sum.low.x, at.x), std::min(sum.low.y, at.y), std::min(sum.low.z, at.z)};
    sum.high = {std::max(sum.high.x, at.x), std::max(sum.high.y, at.y), std::max(sum.high.z, at.z)};
  }
  return sum;
}

class PieceFinder {
 public:
  PieceFinder(const CleanSoup& soup, std::span<const IndexTriangle> triangles,
              const EdgeTable& table, ProgressObserver* progress)
      : soup_(soup), check_(progress), neighbours_(find_neighbours(triangles, table)) {
    result_.of.assign(triangles.size(), kUnseen);
    result_.turned.assign(triangles.size(), 0);
    members_.reserve(triangles.size());
  }

  SurfacePieces run() {
    for (std::uint32_t t = 0; t < result_.of.size(); ++t) {
      if (result_.of[t] == kUnseen) grow_from(t);
    }
    first_.push_back(members_.size());
    parallel_for(result_.pieces.size(), [&](std::size_t p) {
      const std::span members(members_.data() + first_[p], first_[p + 1] - first_[p]);
      if (!result_.pieces[p].orientable) turn_unorientable(members);
      add_up(members, result_.pieces[p]);
    });
    return std::move(result_);
  }

 private:
  static constexpr std::uint32_t kUnseen = ~std::uint32_t{0};

  void grow_from(std::uint32_t seed) {
    const auto id = static_cast<std::uint32_t>(result_.pieces.size());
    SurfacePiece piece;
    first_.push_back(members_.size());
    members_.push_back(seed);
    result_.of[seed] = id;
    for (std::size_t i = first_.back(); i < members_.size(); ++i) {
      check_.tick();
      const std::uint32_t t = members_[i];
      for (const Neighbour& n : neighbours_[t]) {
        if (n.triangle == ~std::uint32_t{0}) continue;
        const bool turn = (result_.turned[t] != 0) == n.agrees;
        if (result_.of[n.triangle] == kUnseen) {
          result_.of[n.triangle] = id;
          result_.turned[n.triangle] = turn ? 1 : 0;
          members_.push_back(n.triangle);
        } else {
          piece.orientable &= (result_.turned[n.triangle] != 0) == turn;
        }
      }
    }
    result_.pieces.push_back(piece);
  }

  // Joins the triangles over their flattest edges first, so that contradictions are left where the
  // surface is folded most: there, the two triangles may be the rest of an edge of more. Turns
  // nothing unless that takes away more than half of the contradictions: what is consistent but for
  // such edges stays as it is.
  void turn_unorientable(std::span<std::uint32_t> members) {
    for (const std::uint32_t t : members) result_.turned[t] = 0;
    std::vector<Fold> folds;
    for (const std::uint32_t t : members) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        const Neighbour& n = neighbours_[t][k];
        if (n.triangle == ~std::uint32_t{0} || n.triangle < t) continue;
        folds.push_back({fold_of(t, k, n.triangle), t, n.triangle, n.agrees});
      }
    }
    std::sort(folds.begin(), folds.end(), [](const Fold& a, const Fold& b) {
      return std::tie(a.fold, a.a, a.b) < std::tie(b.fold, b.a, b.b);
    });
    std::sort(members.begin(), members.end());
    const auto place = [&](std::uint32_t t) {
      return static_cast<std::uint32_t>(std::lower_bound(members.begin(), members.end(), t) -
                                        members.begin());
    };
    TurnSets sets(std::vector<char>(members.size(), 0));
    for (const Fold& f : folds) sets.join(place(f.a), place(f.b), !f.agrees);
    std::size_t before = 0, after = 0;
    for (const Fold& f : folds) {
      before += !f.agrees;
      after += (sets.find(place(f.a)).turned == sets.find(place(f.b)).turned) != f.agrees;
    }
    if (2 * after >= before) return;
    for (const std::uint32_t t : members) result_.turned[t] = sets.find(place(t)).turned ? 1 : 0;
  }

  // -1 where the triangles lie flat beside each other, 1 where they lie on each other. Rounded: it
  // only ranks.
  [[nodiscard]] double fold_of(std::uint32_t t, std::uint32_t k, std::uint32_t other) const {
    const auto at = [&](PointId p) { return as_vector(soup_.grid_points[p]); };
    const auto& corners = soup_.triangles[TriangleId(t)].corners;
    const PointId u = corners[k], v = corners[(k + 1) % 3];
    PointId tip = corners[(k + 2) % 3];
    for (const PointId p : soup_.triangles[TriangleId(other)].corners) {
      if (p != u && p != v) tip = p;
    }
    return fold_cosine(at(u), at(v), at(corners[(k + 2) % 3]), at(tip));
  }

  void add_up(std::span<const std::uint32_t> members, SurfacePiece& piece) {
    const auto add_some = [&](std::size_t first, std::size_t last) {
      SurfacePiece some;
      for (const std::uint32_t t : members.subspan(first, last - first)) {
        const SurfaceSum sum = sum_of(soup_, TriangleId(t));
        some.sum.add(result_.turned[t] != 0 ? sum.turned_round() : sum);
        const Triangle& triangle = soup_.triangles[TriangleId(t)];
        some.doubled &= !says_something(triangle);
        some.closes_holes &= triangle.source == Triangle::kNoSource;
      }
      return some;
    };
    const SurfacePiece all = parallel_reduce(members.size(), kSumsPerTask, add_some,
                                             [](SurfacePiece& sum, const SurfacePiece& some) {
                                               sum.sum.add(some.sum);
                                               sum.doubled &= some.doubled;
                                               sum.closes_holes &= some.closes_holes;
                                             });
    piece.sum = all.sum;
    piece.closes_holes = all.closes_holes;
    piece.doubled = all.doubled && !all.closes_holes;
    if (piece.sum.turned <= piece.sum.kept) return;
    piece.sum = piece.sum.turned_round();
    for (const std::uint32_t t : members) result_.turned[t] ^= 1;
  }

  const CleanSoup& soup_;
  CancelCheck check_;
  Neighbours neighbours_;
  SurfacePieces result_;
  std::vector<std::uint32_t> members_;  // of all pieces, one after the other ...
  std::vector<std::size_t> first_;      // ... and where those of each begin
};

}  // namespace

void SurfaceSum::add(const SurfaceSum& other) {
  area += other.area;
  kept += other.kept;
  turned += other.turned;
  six_volumes += other.six_volumes;
  for (std::size_t k = 0; k < 3; ++k) normal[k] += other.normal[k];
  low = {std::min(low.x, other.low.x), std::min(low.y, other.low.y), std::min(low.z, other.low.z)};
  high = {std::max(high.x, other.high.x), std::max(high.y, other.high.y),
          std::max(high.z, other.high.z)};
}

SurfaceSum SurfaceSum::turned_round() const {
  SurfaceSum sum = *this;
  std::swap(sum.kept, sum.turned);
  sum.six_volumes = -sum.six_volumes;
  for (Int128& n : sum.normal) n = -n;
  return sum;
}

// With 2^32 triangles six_volumes stays below 2^114 and each product of the normal below 2^113.
int SurfaceSum::outward() const {
  return sign_of(2 * six_volumes - normal[0] * (Int128{low.x} + high.x) -
                 normal[1] * (Int128{low.y} + high.y) - normal[2] * (Int128{low.z} + high.z));
}

bool SurfaceSum::nearly_closed() const {
  return stable_length({static_cast<double>(normal[0]), static_cast<double>(normal[1]),
                        static_cast<double>(normal[2])}) <= kHoleShare * area;
}

SurfacePieces find_pieces(const CleanSoup& soup, std::span<const IndexTriangle> triangles,
                          const EdgeTable& table, ProgressObserver* progress) {
  return PieceFinder(soup, triangles, table, progress).run();
}

std::int32_t side_of_corners(const CleanSoup& soup, TriangleId t) {
  const Triangle& triangle = soup.triangles[t];
  if (triangle.winding != 0) return triangle.winding;
  const Plane own = plane_of_corners(soup, t);
  const Plane& shared = soup.planes[triangle.plane];
  const auto axis = static_cast<std::size_t>(dominant_axis(shared));
  return (own.normal[axis] > 0) == (shared.normal[axis] > 0) ? 1 : -1;
}

}  // namespace meshrepair::internal
