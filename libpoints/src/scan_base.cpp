// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include <base/decimal.h>
#include <base/disjoint_sets.h>
#include <base/error.h>
#include <mesh/edge_table.h>
#include <points/scan_base.h>

namespace meshrepair {
namespace {

// A side of one triangle alone.
struct RimEdge {
  std::uint32_t from = 0, to = 0;  // as its triangle passes it
  std::uint32_t part = 0;
  std::uint32_t rim = 0;  // the lowest of its points
};

struct ScanBox {
  Vec3d low = Vec3d::Constant(std::numeric_limits<double>::infinity());
  Vec3d high = -low;

  void add(const Vec3d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  // Of its diagonal, seen along the axis.
  [[nodiscard]] double width(int axis) const {
    Vec3d size = high - low;
    size[axis] = 0;
    return size.norm();
  }
};

std::string text_of(double number) {
  std::array<char, 32> text{};
  return {text.data(), write_decimal(text.data(), text.data() + text.size(), number).ptr};
}

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
    std::vector<std::size_t> counts(soup_.triangles.size(), 0);
    double total = 0;
    for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
      areas[parts_.root(t)] += area(t);
      ++counts[parts_.root(t)];
      total += area(t);
    }
    const std::size_t most = counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end());
    const auto is_large = [&](std::uint32_t part) {
      return areas[part] >= options_.smallest_part * total &&
             static_cast<double>(counts[part]) >=
                 options_.smallest_part * static_cast<double>(most);
    };
    result_.points = soup_.points;
    is_kept_.assign(soup_.triangles.size(), 0);
    for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
      const std::uint32_t part = parts_.root(t);
      is_kept_[part] = is_large(part) ? 1 : 0;
      if (is_kept_[part] != 0) {
        result_.triangles.push_back(soup_.triangles[t]);
      } else {
        ++report_.dropped_triangles;
      }
    }
  }

  // Of each part the rim whose bounding box has the longest diagonal, seen along the axis.
  void choose_rims() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, ScanBox> rims;
    for (const RimEdge& edge : edges_) {
      if (is_kept_[edge.part] != 0) rims[{edge.part, edge.rim}].add(soup_.points[edge.from]);
    }
    std::map<std::uint32_t, double> largest = least_widths();
    for (const auto& [key, box] : rims) {
      double& width = largest[key.first];
      if (box.width(options_.axis) < width) continue;
      width = box.width(options_.axis);
      outer_[key.first] = key.second;
    }
    if (outer_.empty()) {
      throw NoSolidError(
          "nothing is open as wide as it is, so there is no rim for a base; without one its holes "
          "are closed");
    }
    report_.parts = outer_.size();
  }

  // That rims of the parts that are kept need.
  [[nodiscard]] std::map<std::uint32_t, double> least_widths() {
    std::map<std::uint32_t, ScanBox> boxes;
    for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
      const std::uint32_t part = parts_.root(t);
      if (is_kept_[part] == 0) continue;
      ScanBox& box = boxes[part];
      for (const std::uint32_t p : soup_.triangles[t]) box.add(soup_.points[p]);
    }
    std::map<std::uint32_t, double> widths;
    for (const auto& [part, box] : boxes) {
      widths[part] = options_.narrowest_rim * box.width(options_.axis);
    }
    return widths;
  }

  void add_skirts() {
    ScanBox box;
    for (const auto& triangle : result_.triangles) {
      for (const std::uint32_t p : triangle) box.add(soup_.points[p]);
    }
    report_.floor = floor_below(box);
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

  [[nodiscard]] double floor_below(const ScanBox& box) const {
    const double low = box.low[options_.axis];
    const double unit = options_.is_share ? (box.high - box.low).norm() : 1;
    const double floor = options_.floor.value_or(low - options_.depth * unit);
    if (floor < low) return floor;
    throw UsageError("the floor must be below the lowest point, which is at " + text_of(low));
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
