#include "chamber_graph.h"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

namespace meshrepair::internal {
namespace {

// What of a wall is the same for all that one link stands for.
struct Kind {
  std::uint32_t below = 0, above = 0;
  std::uint32_t part = 0;
  std::int32_t winding = 0;
  bool given = false;
  auto operator<=>(const Kind&) const = default;  // NOLINT(modernize-use-nullptr)
};

struct KindOfWall {
  Kind kind;
  std::uint32_t triangle = 0;
  double area = 0;
};

// Adds up those that are alike; each keeps its first triangle.
void merge(std::vector<KindOfWall>& walls) {
  std::stable_sort(walls.begin(), walls.end(),
                   [](const KindOfWall& a, const KindOfWall& b) { return a.kind < b.kind; });
  std::size_t count = 0;
  for (const KindOfWall& wall : walls) {
    if (count > 0 && walls[count - 1].kind == wall.kind) {
      walls[count - 1].area += wall.area;
    } else {
      walls[count++] = wall;
    }
  }
  walls.resize(count);
}

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
    layers.push_back({link_of[layer.wall], TriangleId(layer.triangle)});
  }
  std::vector<KindOfWall> others;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (link_of[i] != kNone) continue;
    const Kind kind = kind_of(walls[i]);
    if (!others.empty() && others.back().kind == kind) {
      others.back().area += walls[i].area;
    } else {
      others.push_back({kind, walls[i].triangle, walls[i].area});
    }
  }
  merge(others);
  for (const KindOfWall& wall : others) add(wall.kind, wall.triangle, wall.area);
  std::vector<char> unbounded(arrangement.chambers(), 0);
  unbounded[Arrangement::kOutside] = 1;
  CellGraph graph(std::move(links), std::move(layers), arrangement.volumes(), std::move(unbounded));
  graph.set_windings(orientation.winding);
  return graph;
}

}  // namespace meshrepair::internal
