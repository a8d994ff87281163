// SPDX-License-Identifier: MIT
// A minimum cut: chambers are nodes, and faces of the lattice between them cost their area. Where
// the ball comes is on the one side, what markers say is behind on the other one. As chambers are
// exact, what the cut parts is parted, whatever the cubes had missed.
#include "fill_behind.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <base/disjoint_sets.h>
#include <repair/chamber_graph.h>
#include <repair/walk.h>

#include "common/minimum_cut.h"

namespace meshrepair::internal {
namespace {

constexpr std::uint32_t kWall = 0, kFace = 1, kFirstMarker = 2;  // parts of the soup

// Costs of all faces together.
constexpr double kAllCosts = 1e15;

class BehindFinder {
 public:
  BehindFinder(const CleanSoup& soup, std::size_t solid_triangles, const SealLattice& lattice,
               const Arrangement& arrangement)
      : soup_(soup),
        lattice_(lattice),
        arrangement_(arrangement),
        first_face_(solid_triangles),
        first_marker_(solid_triangles + lattice.first_marker),
        classes_(arrangement.chambers()),
        nodes_(arrangement.chambers()) {}

  std::optional<FilledChambers> run(ProgressObserver* progress) {
    const CellGraph graph = graph_of_chambers(arrangement_, soup_, orientation());
    const Walk walk = walk_winding(graph, progress);
    if (!walk.consistent()) return std::nullopt;
    // On the working grid, walls that nearly touch may have crossed.
    for (const std::int32_t winding : walk.value) filled_.solid.push_back(winding > 0 ? 1 : 0);
    join_marked(graph);
    set_sides(graph);
    fill(minimum_cut(nodes_, edges_of(graph)));
    return std::move(filled_);
  }

 private:
  [[nodiscard]] std::uint32_t part_of(const Triangle& triangle) const {
    if (triangle.source < first_face_) return kWall;
    if (triangle.source < first_marker_) return kFace;
    const std::size_t number = (triangle.source - first_marker_) / SealLattice::kTrianglesOfMarker;
    return kFirstMarker + static_cast<std::uint32_t>(number);
  }

  [[nodiscard]] Orientation orientation() const {
    Orientation orientation;
    for (const Triangle& t : soup_.triangles) {
      const std::uint32_t part = part_of(t);
      orientation.part_of.push_back(part);
      orientation.winding.push_back(part == kWall ? t.winding * t.layers : 0);
    }
    return orientation;
  }

  [[nodiscard]] std::uint32_t part_of(const Link& link) const {
    return part_of(soup_.triangles[link.triangle]);
  }

  // A marker is where it lies.
  void join_marked(const CellGraph& graph) {
    for (const Link& link : graph.links()) {
      if (part_of(link) >= kFirstMarker) classes_.join(link.below.value, link.above.value);
    }
  }

  void set_sides(const CellGraph& graph) {
    std::vector<char> is_behind(nodes_.size(), 0), is_before(nodes_.size(), 0);  // of each class
    is_before[classes_.root(Arrangement::kOutside)] = 1;
    for (const Link& link : graph.links()) {
      const std::uint32_t part = part_of(link);
      if (part < kFirstMarker) continue;
      const bool behind = lattice_.is_behind[part - kFirstMarker] != 0;
      (behind ? is_behind : is_before)[classes_.root(link.below.value)] = 1;
    }
    for (std::uint32_t c = 0; c < nodes_.size(); ++c) {
      if (classes_.root(c) != c) continue;
      if (is_before[c] != 0 && is_behind[c] != 0) ++filled_.leaks;
      if (is_before[c] != 0) {
        nodes_[c].out = kForbidden;
      } else if (is_behind[c] != 0) {
        nodes_[c].in = kForbidden;
      }
    }
  }

  [[nodiscard]] std::vector<CutEdge> edges_of(const CellGraph& graph) {
    double area = 0;
    for (const Link& link : graph.links()) {
      if (part_of(link) == kFace) area += static_cast<double>(link.area);
    }
    std::vector<CutEdge> edges;
    for (const Link& link : graph.links()) {
      if (part_of(link) != kFace) continue;
      const double cost = kAllCosts * static_cast<double>(link.area) / area;
      edges.push_back({classes_.root(link.below.value), classes_.root(link.above.value),
                       1 + static_cast<std::int64_t>(cost)});
    }
    return edges;
  }

  void fill(const std::vector<char>& is_left) {
    space_of_.assign(filled_.solid.size(), kNone);
    DisjointSets together(filled_.solid.size());
    const auto fills = [&](std::uint32_t c) {
      return filled_.solid[c] == 0 && is_left[classes_.root(c)] == 0;
    };
    for (const ChamberWall& wall : arrangement_.walls()) {
      if (fills(wall.below) && fills(wall.above)) together.join(wall.below, wall.above);
    }
    const std::vector<double> volumes = arrangement_.volumes();
    for (std::uint32_t c = 0; c < space_of_.size(); ++c) {
      if (!fills(c)) continue;
      std::uint32_t& space = space_of_[together.root(c)];  // which is the first of its space
      if (space == kNone) {
        space = static_cast<std::uint32_t>(filled_.spaces.size());
        filled_.spaces.emplace_back();
      }
      space_of_[c] = space;
      filled_.spaces[space].volume += volumes[c];
      filled_.spaces[space].chambers.push_back(c);
    }
    for (const FilledSpace& space : filled_.spaces) {
      for (const std::uint32_t c : space.chambers) filled_.solid[c] = 1;
    }
    measure_patches();
  }

  void measure_patches() {
    DisjointSets patches(soup_.points.size());
    std::vector<std::uint32_t> space_at(soup_.points.size(), kNone);
    for (const ChamberWall& wall : arrangement_.walls()) {
      const Triangle& triangle = soup_.triangles[TriangleId(wall.triangle)];
      if (filled_.solid[wall.below] == filled_.solid[wall.above]) continue;
      const std::uint32_t space =
          space_of_[filled_.solid[wall.below] != 0 ? wall.below : wall.above];
      if (part_of(triangle) != kFace || space == kNone) continue;
      filled_.spaces[space].patches_area += wall.area;
      for (const PointId p : triangle.corners) {
        space_at[p.index()] = space;
        patches.join(triangle.corners[0].value, p.value);
      }
    }
    for (std::uint32_t p = 0; p < space_at.size(); ++p) {
      if (space_at[p] != kNone && patches.root(p) == p) ++filled_.spaces[space_at[p]].openings;
    }
  }

  const CleanSoup& soup_;
  const SealLattice& lattice_;
  const Arrangement& arrangement_;
  std::size_t first_face_, first_marker_;  // as Triangle::source
  DisjointSets classes_;
  std::vector<CutNode> nodes_;           // of each chamber; those that are no roots are free
  std::vector<std::uint32_t> space_of_;  // of each chamber, kNone if it does not become solid
  FilledChambers filled_;
};

}  // namespace

std::optional<FilledChambers> fill_behind(const CleanSoup& soup, std::size_t solid_triangles,
                                          const SealLattice& lattice,
                                          const Arrangement& arrangement,
                                          ProgressObserver* progress) {
  return BehindFinder(soup, solid_triangles, lattice, arrangement).run(progress);
}

}  // namespace meshrepair::internal
