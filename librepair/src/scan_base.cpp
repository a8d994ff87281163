#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <span>
#include <utility>

#include <Eigen/Geometry>

#include <bsp/disjoint_sets.h>
#include <bsp/edge_table.h>
#include <bsp/error.h>
#include <repair/scan_base.h>

namespace meshrepair {
namespace {

// A side of one triangle alone.
struct RimEdge {
  std::uint32_t from = 0, to = 0;  // as its triangle passes it
  std::uint32_t part = 0;
  std::uint32_t rim = 0;  // the lowest of its points
};

class BaseBuilder {
 public:
  BaseBuilder(const TriangleSoup& soup, const ScanBaseOptions& options, ScanBaseReport& report)
      : soup_(soup), options_(options), report_(report), parts_(soup.triangles.size()) {}

  TriangleSoup run() {
    report_ = {};
    find_rims();
    keep_large_parts();
    choose_rims();
    add_skirts();
    return std::move(result_);
  }

 private:
  void find_rims() {
    DisjointSets rims(soup_.points.size());
    EdgeTable(soup_.triangles).for_each_edge([&](std::span<const std::uint32_t> sides) {
      for (const std::uint32_t side : sides) parts_.join(sides[0] / 3, side / 3);
      if (sides.size() != 1) return;
      const std::uint32_t from = side_start(soup_.triangles, sides[0]);
      const std::uint32_t to = side_start(soup_.triangles, next_side(sides[0]));
      edges_.push_back({from, to, sides[0] / 3, 0});
      rims.join(from, to);
    });
    for (RimEdge& edge : edges_) {
      edge.part = parts_.root(edge.part);
      edge.rim = rims.root(edge.from);
    }
  }

  [[nodiscard]] double area(std::size_t triangle) const {
    const auto& [a, b, c] = soup_.triangles[triangle];
    const Vec3d& at = soup_.points[a];
    return 0.5 * (soup_.points[b] - at).cross(soup_.points[c] - at).norm();
  }

  void keep_large_parts() {
    std::vector<double> areas(soup_.triangles.size(), 0);
    double total = 0;
    for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
      areas[parts_.root(t)] += area(t);
      total += area(t);
    }
    result_.points = soup_.points;
    is_kept_.assign(soup_.triangles.size(), 0);
    for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
      const std::uint32_t part = parts_.root(t);
      is_kept_[part] = areas[part] >= options_.smallest_part * total ? 1 : 0;
      if (is_kept_[part] != 0) {
        result_.triangles.push_back(soup_.triangles[t]);
      } else {
        ++report_.dropped_triangles;
      }
    }
  }

  // Of each part the rim whose bounding box has the longest diagonal, seen along the axis.
  void choose_rims() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<Vec3d, 2>> boxes;
    for (const RimEdge& edge : edges_) {
      if (is_kept_[edge.part] == 0) continue;
      const Vec3d& at = soup_.points[edge.from];
      auto& [low, high] =
          boxes.try_emplace({edge.part, edge.rim}, std::array<Vec3d, 2>{at, at}).first->second;
      low = low.cwiseMin(at);
      high = high.cwiseMax(at);
    }
    std::map<std::uint32_t, double> largest;  // of each part
    for (const auto& [key, box] : boxes) {
      Vec3d size = box[1] - box[0];
      size[options_.axis] = 0;
      const auto [entry, added] = largest.try_emplace(key.first, -1.0);
      if (size.norm() <= entry->second) continue;
      entry->second = size.norm();
      outer_[key.first] = key.second;
    }
    if (outer_.empty()) throw NoSolidError("nothing is open, so there is no rim for a base");
    report_.parts = outer_.size();
  }

  void add_skirts() {
    Vec3d low = Vec3d::Constant(std::numeric_limits<double>::infinity());
    Vec3d high = -low;
    for (const auto& triangle : result_.triangles) {
      for (const std::uint32_t p : triangle) {
        low = low.cwiseMin(soup_.points[p]);
        high = high.cwiseMax(soup_.points[p]);
      }
    }
    report_.floor = low[options_.axis] - options_.depth * (high - low).norm();
    for (const RimEdge& edge : edges_) {
      const auto outer = outer_.find(edge.part);
      if (outer == outer_.end() || outer->second != edge.rim) continue;
      const std::uint32_t from = lowered(edge.from);
      const std::uint32_t to = lowered(edge.to);
      result_.triangles.push_back({edge.to, edge.from, from});
      result_.triangles.push_back({edge.to, from, to});
      report_.skirt_triangles += 2;
    }
  }

  // The point of the floor below one.
  std::uint32_t lowered(std::uint32_t point) {
    const auto [entry, added] =
        lowered_.try_emplace(point, static_cast<std::uint32_t>(result_.points.size()));
    if (added) {
      result_.points.push_back(soup_.points[point]);
      result_.points.back()[options_.axis] = report_.floor;
    }
    return entry->second;
  }

  const TriangleSoup& soup_;
  const ScanBaseOptions& options_;
  ScanBaseReport& report_;
  DisjointSets parts_;  // of triangles
  std::vector<RimEdge> edges_;
  std::vector<char> is_kept_;                     // by part
  std::map<std::uint32_t, std::uint32_t> outer_;  // part to rim
  std::map<std::uint32_t, std::uint32_t> lowered_;
  TriangleSoup result_;
};

}  // namespace

TriangleSoup with_base(const TriangleSoup& soup, const ScanBaseOptions& options,
                       ScanBaseReport& report) {
  if (options.axis < 0 || options.axis > 2 || !(options.depth > 0)) {
    throw UsageError("a base needs an axis, 0 to 2, and a depth above 0");
  }
  return BaseBuilder(soup, options, report).run();
}

}  // namespace meshrepair
