// SPDX-License-Identifier: MIT
// The box around the solid is filled with tetrahedra. A corner that is inside the solid and deeper
// than the thickness is in a cavity, and a wall passes between those that are and those that are
// not. A tetrahedron is done once it is proven that
//
// - no point of the wall is less deep than the thickness less the error;
// - no surface is on the side of the cavity;
// - no point on the other side is deeper than the thickness and the error.
//
// So no point of a cavity is less deep than the walls are: on the way to the surface, which passes
// a wall, the depth only falls.
//
// Else it is cut, with those around it. So they become small where the solid is curved or has
// edges, and nowhere else; and what is proven holds for all space, not only for the walls.
#include "walls/find_cavities.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include <base/disjoint_sets.h>
#include <base/error.h>
#include <base/parallel.h>
#include <base/shared_progress.h>
#include <mesh/topology.h>

#include "common/prove_depth.h"
#include "common/soup_box.h"
#include "walls/cut_cell.h"
#include "walls/tetrahedra.h"

namespace meshrepair::internal {
namespace {

constexpr double kCubes = 12;       // along the longest side of the box at first
constexpr double kFinest = 0x1p-6;  // of the thickness: shorter edges are not cut
constexpr std::size_t kMostCells = std::size_t{1} << 25;  // some 4 GB
// For each square of the surface with sides as long as the wall is thick, at the very least: from
// 20 for a cube to 50.
constexpr double kCellsOfSquare = 4;
constexpr std::size_t kCellsPerTask = 64;
// Pieces that are looked at before a tetrahedron is cut: cutting takes longer, and stays.
constexpr std::size_t kMostPieces = 600;
// Of the thickness: in a cavity, surfaces are at least so far away. Any share would do; large ones
// take more pieces to prove, and small ones lead to the same.
constexpr double kFree = 0.25;
constexpr int kClimbs = 60;

struct KeyHash {
  template <std::size_t N>
  std::size_t operator()(const std::array<std::uint32_t, N>& key) const {
    std::uint64_t hash = 0;
    for (const std::uint32_t part : key) {
      hash = (hash ^ part) * 0x9E3779B97F4A7C15u;
      hash ^= hash >> 29;
    }
    return static_cast<std::size_t>(hash);
  }
};

template <std::size_t N>
using KeyMap = std::unordered_map<std::array<std::uint32_t, N>, std::uint32_t, KeyHash>;

constexpr std::uint32_t kNoPoint = ~std::uint32_t{0};

[[noreturn]] void throw_too_many(const CavityOptions& options) {
  throw LimitError(std::string(options.option) +
                   ": so short a distance beside the size of the body takes more than " +
                   std::to_string(kMostCells) + " tetrahedra; a longer one takes fewer");
}

class CavityFinder : public WallPoints {
 public:
  CavityFinder(const TriangleSoup& solid, const Depth& depth, const CavityOptions& options)
      : depth_(depth),
        options_(options),
        finder_(depth, options.thickness, options.error),
        grid_(box_of(solid), longest_side(box_of(solid)) / kCubes),
        progress_(options.progress) {}

  Cavities run() {
    std::vector<std::uint32_t> pending = grid_.take_changed();
    while (!pending.empty()) {
      progress_.begin_step();
      place_points();
      place_wall_points(pending);
      cut(pending, judge(pending));
      pending = grid_.take_changed();
      if (grid_.size() > kMostCells) throw_too_many(options_);
    }
    return collect();
  }

  WallPoint on_edge(std::uint32_t in, std::uint32_t out) const override {
    const std::uint32_t number = edges_.at({std::min(in, out), std::max(in, out)});
    return {number, wall_points_[number]};
  }
  std::optional<WallPoint> in_face(FaceKey face) const override {
    const std::uint32_t number = faces_.at(face);
    if (number == kNoPoint) return std::nullopt;
    return WallPoint{number, wall_points_[number]};
  }

 private:
  enum class Verdict : char { done, cut, given_up };

  [[nodiscard]] bool is_in(std::uint32_t point) const { return in_[point] > 0; }

  // The new points of the grid.
  void place_points() {
    const std::size_t first = places_.size(), count = grid_.points().size() - first;
    places_.resize(first + count);
    in_.resize(first + count);
    for_each_part(count, [&](std::size_t i) {
      const auto number = static_cast<std::uint32_t>(first + i);
      const auto [a, b] = grid_.ends(number);
      const std::uint32_t hint = a < first ? places_[a].nearest : 0;
      Place& place = places_[number];
      place = depth_.place(grid_.points()[number], hint);
      in_[number] = place.distance > options_.thickness ? side_of(number, first) : 0;
    });
  }

  // 1: inside the solid; -1: outside. Known where an end of its edge is so near that the surface
  // cannot pass.
  [[nodiscard]] signed char side_of(std::uint32_t number, std::size_t known) const {
    const Place& place = places_[number];
    for (const std::uint32_t end : grid_.ends(number)) {
      if (end >= known || in_[end] == 0) continue;
      const double reach = std::max(place.distance, places_[end].distance);
      if ((places_[end].at - place.at).squaredNorm() < reach * reach) return in_[end];
    }
    return depth_.is_inside(place.at) ? 1 : -1;
  }

  template <class Body>
  void for_each_part(std::size_t count, const Body& body) {
    SharedProgress shared(&progress_, tasks_of(count, kCellsPerTask));
    parallel_tasks(count, kCellsPerTask, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) body(i);
      shared.done();
    });
  }

  [[nodiscard]] bool is_cut(const std::array<std::uint32_t, 4>& corners) const {
    const auto count = std::count_if(corners.begin(), corners.end(),
                                     [&](std::uint32_t point) { return is_in(point); });
    return count > 0 && count < 4;
  }

  // On edges and in faces of these tetrahedra.
  void place_wall_points(const std::vector<std::uint32_t>& cells) {
    std::vector<EdgeKey> edges;
    std::vector<FaceKey> faces;
    for (const std::uint32_t cell : cells) {
      std::array<std::uint32_t, 4> corners = grid_.corners(cell);
      if (!is_cut(corners)) continue;
      std::sort(corners.begin(), corners.end());
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = i + 1; j < 4; ++j) {
          if (is_in(corners[i]) != is_in(corners[j])) add_edge({corners[i], corners[j]}, edges);
        }
        FaceKey face{};
        std::copy_if(corners.begin(), corners.end(), face.begin(),
                     [&](std::uint32_t corner) { return corner != corners[i]; });
        if (is_in(face[0]) == is_in(face[1]) && is_in(face[1]) == is_in(face[2])) continue;
        if (faces_.emplace(face, kNoPoint).second) faces.push_back(face);
      }
    }
    for_each_part(edges.size(), [&](std::size_t i) {
      auto [a, b] = edges[i];
      if (!is_in(a)) std::swap(a, b);
      wall_points_[edges_.at(edges[i])] = finder_.on_edge(places_[a], places_[b]);
    });
    place_ridges(faces);
  }

  void add_edge(const EdgeKey& edge, std::vector<EdgeKey>& edges) {
    if (!edges_.emplace(edge, static_cast<std::uint32_t>(wall_points_.size())).second) return;
    wall_points_.emplace_back();
    edges.push_back(edge);
  }

  void place_ridges(const std::vector<FaceKey>& faces) {
    std::vector<std::optional<Place>> ridges(faces.size());
    for_each_part(faces.size(), [&](std::size_t i) {
      const auto& [a, b, c] = faces[i];
      std::vector<Place> crossings;
      for (const EdgeKey& edge : {EdgeKey{a, b}, EdgeKey{b, c}, EdgeKey{a, c}}) {
        if (is_in(edge[0]) != is_in(edge[1])) crossings.push_back(wall_points_[edges_.at(edge)]);
      }
      ridges[i] = finder_.in_face({places_[a].at, places_[b].at, places_[c].at}, crossings[0],
                                  crossings[1]);
    });
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if (!ridges[i]) continue;
      faces_[faces[i]] = static_cast<std::uint32_t>(wall_points_.size());
      wall_points_.push_back(*ridges[i]);
    }
  }

  [[nodiscard]] CutCell cell_of(std::uint32_t number) const {
    CutCell cell;
    cell.corners = grid_.corners(number);
    const auto at = [&](std::size_t i) { return places_[cell.corners[i]].at; };
    if ((at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) < 0) {
      std::swap(cell.corners[2], cell.corners[3]);
    }
    for (std::size_t i = 0; i < 4; ++i) {
      cell.places[i] = places_[cell.corners[i]];
      cell.in[i] = is_in(cell.corners[i]);
    }
    return cell;
  }

  std::vector<Verdict> judge(const std::vector<std::uint32_t>& cells) {
    std::vector<Verdict> verdicts(cells.size());
    for_each_part(cells.size(), [&](std::size_t i) {
      verdicts[i] = is_proven(cells[i])                 ? Verdict::done
                    : longest_edge(cells[i]) < finest() ? Verdict::given_up
                                                        : Verdict::cut;
    });
    return verdicts;
  }

  [[nodiscard]] double finest() const { return kFinest * options_.thickness; }

  [[nodiscard]] double longest_edge(std::uint32_t cell) const {
    double longest = 0;
    for (const std::uint32_t a : grid_.corners(cell)) {
      for (const std::uint32_t b : grid_.corners(cell)) {
        longest = std::max(longest, (places_[a].at - places_[b].at).squaredNorm());
      }
    }
    return std::sqrt(longest);
  }

  // All of it, for sure; no corner is in a cavity.
  [[nodiscard]] bool is_outside(const CutCell& cell) const {
    for (std::size_t i = 0; i < 4; ++i) {
      const double distance = cell.places[i].distance;
      if (reach_of(cell.places, i) >= distance) continue;
      // The surface does not pass.
      return in_[cell.corners[i]] < 0 || !depth_.is_inside(cell.places[i].at);
    }
    return false;
  }

  // No surface is in it, as a corner is farther from that than from all of it.
  [[nodiscard]] static bool is_clear(const CutCell& cell) {
    for (std::size_t i = 0; i < 4; ++i) {
      if (cell.in[i] && reach_of(cell.places, i) < cell.places[i].distance) return true;
    }
    return false;
  }

  static std::vector<Piece> pieces_of(const WallInCell& wall) {
    std::vector<Piece> pieces;
    for (const auto& [a, b, c] : wall.triangles) {
      pieces.push_back({a.place, b.place, c.place, c.place});
    }
    return pieces;
  }

  [[nodiscard]] bool is_proven(std::uint32_t number) const {
    const CutCell cell = cell_of(number);
    const double least = options_.thickness - options_.error;
    const double most = options_.thickness + options_.error;
    DepthProver prover(depth_, kMostPieces);
    const auto is_free = [&](const Piece& piece) {
      return prover.is_beyond(piece, kFree * options_.thickness) == Proof::holds;
    };
    if (!is_cut(cell.corners)) {
      if (cell.in[0]) return is_clear(cell) || is_free(cell.places);
      return is_outside(cell) || prover.is_within(cell.places, most) == Proof::holds;
    }
    const WallInCell wall = wall_in(cell, *this, finder_);
    const auto all_of = [](const std::vector<Piece>& pieces, const auto& proof) {
      return std::all_of(pieces.begin(), pieces.end(), proof);
    };
    const auto is_within = [&](const Piece& piece) {
      return prover.is_within(piece, most) == Proof::holds;
    };
    const auto is_beyond = [&](const Piece& piece) {
      return prover.is_beyond(piece, least) == Proof::holds;
    };
    return all_of(wall.out, is_within) && all_of(pieces_of(wall), is_beyond) &&
           (is_clear(cell) || all_of(wall.in, is_free));
  }

  void cut(const std::vector<std::uint32_t>& cells, const std::vector<Verdict>& verdicts) {
    std::vector<int> levels;
    levels.reserve(cells.size());
    for (const std::uint32_t cell : cells) levels.push_back(grid_.level(cell));
    state_.resize(grid_.size());
    for (std::size_t i = 0; i < cells.size(); ++i) state_[cells[i]] = verdicts[i];
    CancelCheck check(options_.progress);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      check.tick();
      // Others may have led to its cut.
      if (verdicts[i] == Verdict::cut && grid_.level(cells[i]) == levels[i]) grid_.bisect(cells[i]);
      if (grid_.size() > kMostCells) return;
    }
  }

  Cavities collect() {
    Cavities found;
    found.cells = grid_.size();
    found.finest = std::numeric_limits<double>::infinity();
    DisjointSets sets(places_.size());
    std::vector<std::uint32_t> one;  // of each triangle, a point of the grid in its cavity
    std::vector<std::uint32_t> number(wall_points_.size(), kNoPoint);
    CancelCheck check(options_.progress);
    for (std::uint32_t t = 0; t < grid_.size(); ++t) {
      check.tick();
      found.unproven += state_[t] == Verdict::given_up ? 1 : 0;
      std::uint32_t first = kNoPoint;
      for (const std::uint32_t point : grid_.corners(t)) {
        if (!is_in(point)) continue;
        if (first == kNoPoint) first = point;
        sets.join(first, point);
      }
      if (!is_cut(grid_.corners(t))) continue;
      found.finest = std::min(found.finest, longest_edge(t));
      add_walls(wall_in(cell_of(t), *this, finder_), number, found);
      one.resize(found.walls.triangles.size(), first);
    }
    name_cavities(sets, one, found);
    return found;
  }

  void add_walls(const WallInCell& wall, std::vector<std::uint32_t>& number,
                 Cavities& found) const {
    std::uint32_t tip = kNoPoint;
    for (const auto& triangle : wall.triangles) {
      std::array<std::uint32_t, 3> corners{};
      for (std::size_t i = 0; i < 3; ++i) {
        const WallPoint& point = triangle[i];
        std::uint32_t& known = point.number == kTip ? tip : number[point.number];
        if (known == kNoPoint) {
          known = static_cast<std::uint32_t>(found.walls.points.size());
          found.walls.points.push_back(point.place.at);
        }
        corners[i] = known;
      }
      found.walls.triangles.push_back(corners);
    }
  }

  // By their first points in the grid.
  void name_cavities(DisjointSets& sets, const std::vector<std::uint32_t>& one, Cavities& found) {
    std::vector<std::uint32_t> name(places_.size(), kNoPoint);
    for (std::uint32_t point = 0; point < places_.size(); ++point) {
      if (!is_in(point)) continue;
      std::uint32_t& cavity = name[sets.root(point)];
      if (cavity == kNoPoint) {
        cavity = static_cast<std::uint32_t>(found.deepest.size());
        found.deepest.push_back(places_[point]);
      }
      Place& deepest = found.deepest[cavity];
      if (places_[point].distance > deepest.distance) deepest = places_[point];
    }
    for (const std::uint32_t point : one) found.cavity.push_back(name[sets.root(point)]);
    for (Place& deepest : found.deepest) climb(deepest);
  }

  // Up to a place around which none is deeper: steps along the axes, halved when they lead nowhere.
  void climb(Place& place) const {
    double step = 0.5 * place.distance;
    for (int i = 0; i < kClimbs && step > finest(); ++i) {
      Place best = place;
      for (Eigen::Index k = 0; k < 3; ++k) {
        for (const double sign : {-1.0, 1.0}) {
          // No step leaves the ball around the place in which nothing of the surface is.
          const Place other = depth_.place(place.at + sign * step * Vec3d::Unit(k), place.nearest);
          if (other.distance > best.distance) best = other;
        }
      }
      if (best.distance > place.distance) {
        place = best;
      } else {
        step *= 0.5;
      }
    }
  }

  const Depth& depth_;
  const CavityOptions& options_;
  WallFinder finder_;
  Tetrahedra grid_;
  HalvedStage progress_;         // each round is a step
  std::vector<Place> places_;    // of the points of the grid
  std::vector<signed char> in_;  // 1: deeper than the thickness; -1: so far outside; 0: neither
  std::vector<Verdict> state_;
  KeyMap<2> edges_;
  KeyMap<3> faces_;
  std::vector<Place> wall_points_;
};

}  // namespace

Cavities find_cavities(const TriangleSoup& solid, const Depth& depth,
                       const CavityOptions& options) {
  const double squares = surface_area(solid) / (options.thickness * options.thickness);
  if (kCellsOfSquare * squares > static_cast<double>(kMostCells)) throw_too_many(options);
  return CavityFinder(solid, depth, options).run();
}

}  // namespace meshrepair::internal
