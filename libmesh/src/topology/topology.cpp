// SPDX-License-Identifier: MIT
#include <atomic>
#include <numeric>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <base/parallel.h>
#include <base/shared_sets.h>
#include <mesh/topology.h>

namespace meshrepair {
namespace {

void count_edge(std::span<const IndexTriangle> triangles, std::span<const std::uint32_t> sides,
                Topology& topology) {
  ++topology.edges;
  topology.open_edges += sides.size() == 1;
  topology.nonmanifold_edges += sides.size() > 2;
  topology.inconsistent_edges +=
      sides.size() == 2 && side_start(triangles, sides[0]) == side_start(triangles, sides[1]);
}

void note_edge(std::span<const IndexTriangle> triangles, std::span<const std::uint32_t> sides,
               TopologyPlaces& places) {
  const auto add_to = [&](std::vector<std::uint32_t>& list) {
    list.insert(list.end(), sides.begin(), sides.end());
  };
  if (sides.size() == 1) {
    add_to(places.open_sides);
  } else if (sides.size() > 2) {
    add_to(places.nonmanifold_sides);
  } else if (side_start(triangles, sides[0]) == side_start(triangles, sides[1])) {
    add_to(places.inconsistent_sides);
  }
}

constexpr std::size_t kEdgesPerTask = 16384;

// What a list of edges tells.
struct Edges {
  Topology counts;
  TopologyPlaces places;

  void add(const Edges& other) {
    counts.edges += other.counts.edges;
    counts.open_edges += other.counts.open_edges;
    counts.nonmanifold_edges += other.counts.nonmanifold_edges;
    counts.inconsistent_edges += other.counts.inconsistent_edges;
    append(places.open_sides, other.places.open_sides);
    append(places.nonmanifold_sides, other.places.nonmanifold_sides);
    append(places.inconsistent_sides, other.places.inconsistent_sides);
  }

 private:
  static void append(std::vector<std::uint32_t>& all, const std::vector<std::uint32_t>& some) {
    all.insert(all.end(), some.begin(), some.end());
  }
};

// Joins the two pairs of corners that the triangles on both sides of an edge have in common.
void join_corners(std::span<const IndexTriangle> triangles, std::uint32_t s, std::uint32_t t,
                  SharedSets& corners) {
  const bool opposite = side_start(triangles, s) != side_start(triangles, t);
  corners.join(s, opposite ? next_side(t) : t);
  corners.join(next_side(s), opposite ? t : next_side(t));
}

constexpr std::size_t kItemsPerTask = 32768;

void add_to(std::size_t& all, std::size_t some) { all += some; }

// The lowest corner of a fan stands for it. A vertex is split if there are more of them.
std::size_t count_split_vertices(std::span<const IndexTriangle> triangles, std::size_t points,
                                 SharedSets& corners, TopologyPlaces* places) {
  constexpr char kOneFan = 1, kMoreFans = 2;
  std::vector<char> fans(points, 0);
  parallel_tasks(3 * triangles.size(), kItemsPerTask,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t i = first; i < last; ++i) {
                     const auto c = static_cast<std::uint32_t>(i);
                     if (corners.root(c) != c) continue;
                     const std::atomic_ref<char> seen(fans[side_start(triangles, c)]);
                     if (seen.fetch_or(kOneFan, std::memory_order_relaxed) != 0) {
                       seen.fetch_or(kMoreFans, std::memory_order_relaxed);
                     }
                   }
                 });
  const auto find_split = [&](std::size_t first, std::size_t last) {
    std::vector<std::uint32_t> split;
    for (std::size_t v = first; v < last; ++v) {
      if ((fans[v] & kMoreFans) != 0) split.push_back(static_cast<std::uint32_t>(v));
    }
    return split;
  };
  std::vector<std::uint32_t> split =
      parallel_reduce(points, kItemsPerTask, find_split,
                      [](std::vector<std::uint32_t>& all, const std::vector<std::uint32_t>& some) {
                        all.insert(all.end(), some.begin(), some.end());
                      });
  const std::size_t count = split.size();
  if (places != nullptr) places->nonmanifold_vertices = std::move(split);
  return count;
}

// The lowest triangle of a part stands for it, so the parts are in the order of these.
std::vector<std::uint32_t> number_parts(std::size_t triangles, SharedSets& sets) {
  std::vector<std::uint32_t> parts(triangles);
  std::vector<std::uint32_t> number(tasks_of(triangles, kItemsPerTask), 0);
  const auto for_all = [&](const auto& visit) {
    parallel_tasks(triangles, kItemsPerTask,
                   [&](std::size_t task, std::size_t first, std::size_t last) {
                     for (std::size_t i = first; i < last; ++i) {
                       const auto t = static_cast<std::uint32_t>(i);
                       visit(task, t, sets.root(t));
                     }
                   });
  };
  for_all(
      [&](std::size_t task, std::uint32_t t, std::uint32_t root) { number[task] += root == t; });
  std::exclusive_scan(number.begin(), number.end(), number.begin(), std::uint32_t{0});
  for_all([&](std::size_t task, std::uint32_t t, std::uint32_t root) {
    if (root == t) parts[t] = number[task]++;
  });
  for_all([&](std::size_t, std::uint32_t t, std::uint32_t root) {
    if (root != t) parts[t] = parts[root];
  });
  return parts;
}

}  // namespace

Topology examine_topology(std::span<const IndexTriangle> triangles, std::size_t points,
                          TopologyPlaces* places) {
  if (places != nullptr) *places = {};
  SharedSets parts(triangles.size());
  SharedSets corners(3 * triangles.size());
  const EdgeTable table(triangles);
  const auto examine = [&](std::size_t first, std::size_t last) {
    Edges some;
    for (std::size_t edge = first; edge < last; ++edge) {
      const std::span<const std::uint32_t> sides = table.sides(edge);
      count_edge(triangles, sides, some.counts);
      if (places != nullptr) note_edge(triangles, sides, some.places);
      for (std::size_t i = 1; i < sides.size(); ++i) {
        parts.join(sides[0] / 3, sides[i] / 3);
        join_corners(triangles, sides[0], sides[i], corners);
      }
    }
    return some;
  };
  Edges edges = parallel_reduce(table.edges(), kEdgesPerTask, examine,
                                [](Edges& all, const Edges& some) { all.add(some); });
  if (places != nullptr) *places = std::move(edges.places);
  Topology topology = edges.counts;
  topology.triangles = triangles.size();
  const auto repeated = [&](std::size_t first, std::size_t last) {
    std::size_t found = 0;
    for (const IndexTriangle& t : triangles.subspan(first, last - first)) {
      found += t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
    }
    return found;
  };
  topology.repeated_corners = parallel_reduce(triangles.size(), kItemsPerTask, repeated, &add_to);
  topology.parts = parts.count();
  topology.nonmanifold_vertices = count_split_vertices(triangles, points, corners, places);
  if (places != nullptr) places->parts = number_parts(triangles.size(), parts);
  return topology;
}

std::vector<char> triangles_of_open_parts(std::span<const IndexTriangle> triangles,
                                          std::size_t points) {
  TopologyPlaces places;
  const Topology topology = examine_topology(triangles, points, &places);
  std::vector<char> is_open(topology.parts, 0);
  for (const std::uint32_t side : places.open_sides) is_open[places.parts[side / 3]] = 1;
  std::vector<char> open;
  open.reserve(places.parts.size());
  for (const std::uint32_t part : places.parts) open.push_back(is_open[part]);
  return open;
}

double signed_volume(const TriangleSoup& soup) {
  if (soup.triangles.empty()) return 0;
  const Vec3d base = soup.points[soup.triangles[0][0]];
  double sum = 0;
  for (const auto& t : soup.triangles) {
    const Vec3d a = soup.points[t[0]] - base;
    const Vec3d b = soup.points[t[1]] - base;
    const Vec3d c = soup.points[t[2]] - base;
    sum += a.dot(b.cross(c));
  }
  return sum / 6;
}

double surface_area(const TriangleSoup& soup) {
  double sum = 0;
  for (const auto& t : soup.triangles) {
    const Vec3d& a = soup.points[t[0]];
    sum += (soup.points[t[1]] - a).cross(soup.points[t[2]] - a).norm();
  }
  return sum / 2;
}

}  // namespace meshrepair
