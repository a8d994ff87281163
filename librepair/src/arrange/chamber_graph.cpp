// SPDX-License-Identifier: MIT
#include <cstdint>
#include <utility>
#include <vector>

#include <base/internal/hash_index.h>
#include <repair/chamber_graph.h>

namespace meshrepair {
namespace {

using internal::hash_mix;
using internal::HashIndex;

// What of a wall is the same for all that one link stands for.
struct Kind {
  std::uint32_t below = 0, above = 0;
  std::uint32_t part = 0;
  std::int32_t winding = 0;
  bool given = false;
  bool operator==(const Kind&) const = default;
};

std::uint64_t hash_of(const Kind& kind) {
  std::uint64_t h = hash_mix(0, std::uint64_t{kind.below} << 32 | kind.above);
  h = hash_mix(h, std::uint64_t{kind.part} << 1 | (kind.given ? 1 : 0));
  return hash_mix(h, static_cast<std::uint64_t>(std::int64_t{kind.winding}));
}

struct KindOfWall {
  Kind kind;
  std::uint32_t triangle = 0;  // the first one
  double area = 0;             // of all
};

// Adds up walls of one kind, in the order in which kinds come first.
class WallMerger {
 public:
  void add(const Kind& kind, std::uint32_t triangle, double area) {
    if (index_.full(walls_.size())) {
      index_.grow(static_cast<std::uint32_t>(walls_.size()),
                  [&](std::uint32_t i) { return hash_of(walls_[i].kind); });
    }
    const auto fresh = static_cast<std::uint32_t>(walls_.size());
    const std::uint32_t at = index_.find_or_insert(
        hash_of(kind), fresh, [&](std::uint32_t i) { return walls_[i].kind == kind; });
    if (at == fresh) walls_.push_back({kind, triangle, 0});
    walls_[at].area += area;
  }
  [[nodiscard]] const std::vector<KindOfWall>& walls() const { return walls_; }

 private:
  std::vector<KindOfWall> walls_;
  HashIndex index_{1024};
};

}  // namespace

CellGraph graph_of_chambers(const Arrangement& arrangement, const CleanSoup& soup,
                            const Orientation& orientation) {
  const std::vector<ChamberWall> walls = arrangement.walls();
  std::vector<Link> links;
  const auto add = [&](const Kind& kind, std::uint32_t triangle, double area) {
    links.push_back({CellId(kind.below), CellId(kind.above), static_cast<float>(area), kind.winding,
                     1.0f, TriangleId(triangle), kind.given});
  };
  const auto kind_of = [&](const ChamberWall& wall) {
    const TriangleId t(wall.triangle);
    return Kind{wall.below, wall.above, orientation.part_of[t], orientation.winding[t],
                soup.triangles[t].source != Triangle::kNoSource};
  };
  std::vector<CellGraph::Layer> layers;
  std::vector<std::uint32_t> link_of(walls.size(), kNone);
  for (const Arrangement::Layer& layer : arrangement.layers()) {
    if (link_of[layer.wall] == kNone) {
      link_of[layer.wall] = static_cast<std::uint32_t>(links.size());
      const ChamberWall& wall = walls[layer.wall];
      add(kind_of(wall), wall.triangle, wall.area);
    }
    const TriangleId t(layer.triangle);
    layers.push_back({link_of[layer.wall], t, soup.triangles[t].source != Triangle::kNoSource});
  }
  WallMerger others;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (link_of[i] == kNone) others.add(kind_of(walls[i]), walls[i].triangle, walls[i].area);
  }
  for (const KindOfWall& wall : others.walls()) add(wall.kind, wall.triangle, wall.area);
  std::vector<char> unbounded(arrangement.chambers(), 0);
  unbounded[Arrangement::kOutside] = 1;
  CellGraph graph(std::move(links), std::move(layers), arrangement.volumes(), std::move(unbounded));
  graph.set_windings(orientation.winding);
  return graph;
}

}  // namespace meshrepair
