// SPDX-License-Identifier: MIT
// A chamber is a connected region that no facet divides. Idea: each facet has two sides, and each
// side lies in one chamber, so chambers are classes of sides. Sides are joined across edges with
// two facets, and around the other edges, where what is after a facet and before the next one is
// the same place.
//
// That leaves each connected part of the surface with classes of its own. Which chamber of the
// others a part lies in, a ray tells that starts at a corner far out, beyond which nothing of the
// part itself is: the side above that corner is that of the first facet above it, or the outside
// where there is none. Exact: heights over a point are compared as fractions of integers, and a ray
// that meets an edge or two facets in one plane is not believed, but another one asked. Where none
// tells, there are no chambers, and the caller makes cells.
//
// Compare Q. Zhou, E. Grinspun, D. Zorin and A. Jacobson, Mesh arrangements for solid geometry
// (2016), whose cells are these chambers.
#include "chambers.h"

#include <algorithm>

#include <base/ids.h>
#include <base/parallel.h>
#include <base/shared_sets.h>
#include <check/soup_rays.h>
#include <exact/predicates.h>

namespace meshrepair::internal {
namespace {

// So many triangles of a part are tried, the highest ones first.
constexpr std::size_t kMostRays = 32;

constexpr std::size_t kJoinsPerTask = 16384;

class ChamberFinder {
 public:
  ChamberFinder(const CutSet& cut, const ArrangedPoints& points, const Sheets& sheets,
                const SheetEdges& edges, const Stacks& stacks, ProgressObserver* progress)
      : cut_(cut),
        points_(points),
        soup_(cut.soup()),
        sheets_(sheets),
        edges_(edges),
        stacks_(stacks),
        check_(progress),
        sides_(2 * sheets.size() + 1),
        parts_(sheets.size()),
        is_reached_(sheets.size(), 0) {}

  std::optional<Chambers> run() {
    parallel_tasks(3 * sheets_.size(), kJoinsPerTask,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     for (std::size_t s = first; s < last; ++s) join_across(s);
                   });
    check_.ask();
    parallel_tasks(edges_.size(), kJoinsPerTask,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     for (std::size_t e = first; e < last; ++e) walk_around(e);
                   });
    check_.ask();
    if (!place_parts()) return std::nullopt;
    return number();
  }

 private:
  static std::uint32_t front(std::uint32_t f) { return 2 * f; }
  static std::uint32_t behind(std::uint32_t f) { return 2 * f + 1; }
  [[nodiscard]] std::uint32_t outside() const {
    return static_cast<std::uint32_t>(2 * sheets_.size());
  }

  void join_across(std::size_t slot) {
    const std::uint32_t other = sheets_.across[slot];
    if (other == kNone || other < slot) return;
    const auto facet = static_cast<std::uint32_t>(slot / 3);
    sides_.join(front(facet), front(other / 3));
    sides_.join(behind(facet), behind(other / 3));
    parts_.join(facet, other / 3);
  }

  // After a facet and before the next one is the same place.
  void walk_around(std::size_t edge) {
    const auto slots = edges_.slots(edge);
    for (std::size_t i = 0; i < slots.size(); ++i) {
      const std::uint32_t s = slots[i], next = slots[i + 1 < slots.size() ? i + 1 : 0];
      const std::uint32_t f = s / 3, g = next / 3;
      sides_.join(edges_.leads_up(s) ? front(f) : behind(f),
                  edges_.leads_up(next) ? behind(g) : front(g));
      parts_.join(f, g);
    }
  }

  // By rays from where nothing of the part itself is beyond, which are found near the points that
  // are farthest out: along z, or x and y where that does not tell.
  bool place_parts() {
    std::vector<char> is_placed(sheets_.size(), 0);  // of the first facet of each part
    for (const std::size_t axis : {std::size_t{2}, std::size_t{0}, std::size_t{1}}) {
      axis_ = axis;
      std::vector<std::vector<CornerRay>> rays = list_rays(is_placed);
      if (rays.empty()) return true;
      cast(rays);
      for (std::uint32_t f = 0; f < sheets_.size(); ++f) {
        if (parts_.root(f) == f) is_placed[f] = is_reached_[f];
      }
    }
    return list_rays(is_placed).empty();
  }

  // Of each list, one after the other until one tells.
  void cast(std::vector<std::vector<CornerRay>>& rays) {
    const TriangleSoup on_grid = put_on_grid();
    for (std::size_t round = 0; round < kMostRays; ++round) {
      std::vector<CornerRay> asked;
      std::vector<std::uint32_t> part;
      for (std::uint32_t p = 0; p < rays.size(); ++p) {
        if (rays[p].size() <= round) continue;
        asked.push_back(rays[p][round]);
        part.push_back(p);
      }
      if (asked.empty()) break;
      const auto above = triangles_above(on_grid, asked);
      for (std::size_t i = 0; i < asked.size(); ++i) {
        if (!place(asked[i], above[i])) continue;
        is_reached_[parts_.root(sheets_.first[asked[i].triangle])] = 1;
        rays[part[i]].clear();
      }
    }
  }

  // Whether the ray tells.
  bool place(const CornerRay& ray, const std::vector<std::uint32_t>& above) {
    const std::uint32_t own = side_above(facet_at(ray));
    const std::uint32_t part = parts_.root(own / 2);
    const auto is_own = [&](std::uint32_t t) { return parts_.root(sheets_.first[t]) == part; };
    if (std::any_of(above.begin(), above.end(), is_own)) return false;
    if (above.empty()) {
      sides_.join(own, outside());
      return true;
    }
    const std::optional<std::uint32_t> nearest = nearest_of(above, ray);
    if (!nearest) return false;
    const std::uint32_t g = facet_above(*nearest, ray);
    if (g == kNone) return false;
    sides_.join(own, facing_up(*nearest) > 0 ? behind(g) : front(g));
    return true;
  }

  // Of all facets in its place, none of which a ray from one of them hits.
  [[nodiscard]] std::uint32_t side_above(std::uint32_t f) const {
    if (stacks_.contains(f)) {
      const auto stack = stacks_.of(f);
      const Plane& plane = soup_.planes[soup_.triangles[TriangleId(sheets_.triangle[f])].plane];
      f = plane.normal[axis_] > 0 ? stack.back() : stack.front();
    }
    return facing_up(sheets_.triangle[f]) > 0 ? front(f) : behind(f);
  }

  // Nothing if there are two in one plane.
  [[nodiscard]] std::optional<std::uint32_t> nearest_of(const std::vector<std::uint32_t>& above,
                                                        const CornerRay& ray) const {
    std::uint32_t nearest = above[0];
    bool alone = true;
    for (std::size_t i = 1; i < above.size(); ++i) {
      const int order = compare_heights(above[i], nearest, ray);
      if (order == 0) alone = false;
      if (order >= 0) continue;
      nearest = above[i];
      alone = true;
    }
    return alone ? std::optional(nearest) : std::nullopt;
  }

  // Of the planes of two triangles over a ray: where both meet over the corner that it starts from,
  // one is higher on the way into the triangle.
  [[nodiscard]] int compare_heights(std::uint32_t t, std::uint32_t u, const CornerRay& ray) const {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const int order = compare_heights(t, u, corner_of(ray, k));
      if (order != 0) return order;
    }
    return 0;
  }

  // The same over a point. With normals below 2^54, offsets below 2^81 and
  // coordinates below 2^25 the height of a plane is a fraction of 2^82 by 2^54.
  [[nodiscard]] int compare_heights(std::uint32_t t, std::uint32_t u, const GridPoint& at) const {
    const auto height = [&](std::uint32_t triangle, Int128& over, Int128& under) {
      const Plane& plane = soup_.planes[soup_.triangles[TriangleId(triangle)].plane];
      const std::size_t x = (axis_ + 1) % 3, y = (axis_ + 2) % 3;
      over = -(Int128{plane.normal[x]} * coordinate(at, x) +
               Int128{plane.normal[y]} * coordinate(at, y) + plane.offset);
      under = plane.normal[axis_];
      if (under < 0) over = -over, under = -under;
    };
    Int128 over_t = 0, under_t = 0, over_u = 0, under_u = 0;
    height(t, over_t, under_t);
    height(u, over_u, under_u);
    return (Int256::product(over_t, under_u) + -Int256::product(over_u, under_t)).sign();
  }

  // The facet of a triangle that a ray passes; kNone where that is hard to tell.
  [[nodiscard]] std::uint32_t facet_above(std::uint32_t t, const CornerRay& ray) {
    const std::uint32_t first = sheets_.first[t], last = sheets_.first[t + 1];
    if (last - first == 1) return first;
    if (planes_.size() == 0) planes_ = cut_.planes();
    const PlaneId own = cut_.plane(cut_.number_of(t));
    const std::array<Point, 3> over = {place_over(corner_of(ray, 0), own),
                                       place_over(corner_of(ray, 1), own),
                                       place_over(corner_of(ray, 2), own)};
    if (std::any_of(over.begin(), over.end(), [](const Point& p) { return p.is_loose(); })) {
      return kNone;
    }
    const int left = corner_side(soup_, t);
    for (std::uint32_t f = first; f < last; ++f) {
      const auto& c = sheets_.corners[f];
      bool inside = true;
      for (std::size_t k = 0; k < 3 && inside; ++k) {
        inside = side_of_ray(points_.at(c[k]), points_.at(c[(k + 1) % 3]), over, own) == left;
      }
      if (inside) return f;
    }
    return kNone;
  }

  // In a plane, straight above a point or below it.
  [[nodiscard]] Point place_over(const GridPoint& at, PlaneId plane) {
    const auto upright = [&](std::size_t axis) {
      std::array<std::int64_t, 3> normal{};
      normal[axis] = 1;
      return planes_.append(make_plane(normal, -Int128{coordinate(at, axis)}));
    };
    const PlaneId x = upright((axis_ + 1) % 3), y = upright((axis_ + 2) % 3);
    return meet(planes_, plane, x, y, {});
  }

  // Where the line through a and b has the ray: the first of its three places decides that the line
  // does not pass through. The two that come later lead from the first one into the triangle.
  [[nodiscard]] int side_of_ray(const Point& a, const Point& b, const std::array<Point, 3>& over,
                                PlaneId plane) const {
    for (const Point& place : over) {
      const int side = turn(a, b, place, plane, planes_);
      if (side != 0) return side;
    }
    return 0;
  }

  // The corner that a ray starts from, and the next ones of its triangle.
  [[nodiscard]] const GridPoint& corner_of(const CornerRay& ray, std::uint32_t k) const {
    const auto& corners = soup_.triangles[TriangleId(ray.triangle)].corners;
    return soup_.grid_points[corners[(ray.corner + k) % 3]];
  }

  static std::int32_t coordinate(const GridPoint& p, std::size_t axis) {
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
  }

  // Of each part that is not placed yet, corners far out from which a ray may start.
  std::vector<std::vector<CornerRay>> list_rays(const std::vector<char>& is_placed) {
    std::vector<std::uint32_t> number(sheets_.size(), kNone);
    std::vector<std::vector<CornerRay>> rays;
    const auto higher = [&](const CornerRay& a, const CornerRay& b) {
      return is_higher(point_of(a), point_of(b));
    };
    for (std::uint32_t t = 0; t + 1 < sheets_.first.size(); ++t) {
      const std::uint32_t root = parts_.root(sheets_.first[t]);
      if (is_placed[root] != 0) continue;
      if (number[root] == kNone) {
        number[root] = static_cast<std::uint32_t>(rays.size());
        rays.emplace_back();
      }
      std::vector<CornerRay>& of_part = rays[number[root]];
      for (std::uint32_t k = 0; k < 3; ++k) {
        const CornerRay ray = {t, k};
        const bool is_full = of_part.size() == kMostRays;
        if (is_full && !higher(ray, of_part.back())) continue;
        if (facing_up(t) == 0 || facet_at(ray) == kNone) continue;
        if (is_full) of_part.pop_back();
        of_part.insert(std::upper_bound(of_part.begin(), of_part.end(), ray, higher), ray);
      }
    }
    return rays;
  }

  [[nodiscard]] std::uint32_t point_of(const CornerRay& ray) const {
    return soup_.triangles[TriangleId(ray.triangle)].corners[ray.corner].value;
  }

  [[nodiscard]] bool is_higher(std::uint32_t p, std::uint32_t q) const {
    const GridPoint& a = soup_.grid_points[PointId(p)];
    const GridPoint& b = soup_.grid_points[PointId(q)];
    for (const std::size_t k : {axis_, (axis_ + 2) % 3}) {
      if (coordinate(a, k) != coordinate(b, k)) return coordinate(a, k) > coordinate(b, k);
    }
    return coordinate(a, (axis_ + 1) % 3) > coordinate(b, (axis_ + 1) % 3);
  }

  // Turned so that the axis is z.
  [[nodiscard]] TriangleSoup put_on_grid() const {
    TriangleSoup mesh;
    mesh.points.reserve(soup_.points.size());
    mesh.triangles.reserve(soup_.triangles.size());
    for (const GridPoint& p : soup_.grid_points) {
      mesh.points.emplace_back(coordinate(p, (axis_ + 1) % 3), coordinate(p, (axis_ + 2) % 3),
                               coordinate(p, axis_));
    }
    for (const Triangle& t : soup_.triangles) {
      mesh.triangles.push_back({t.corners[0].value, t.corners[1].value, t.corners[2].value});
    }
    return mesh;
  }

  // 1 if the triangle's corners are counter-clockwise as seen from where the axis points.
  [[nodiscard]] int facing_up(std::uint32_t t) const {
    const auto& c = soup_.triangles[TriangleId(t)].corners;
    const auto step = [&](std::size_t corner, std::size_t axis) {
      return std::int64_t{coordinate(soup_.grid_points[c[corner]], axis)} -
             coordinate(soup_.grid_points[c[0]], axis);
    };
    const std::size_t x = (axis_ + 1) % 3, y = (axis_ + 2) % 3;
    const std::int64_t area = step(1, x) * step(2, y) - step(1, y) * step(2, x);
    return (area > 0) - (area < 0);
  }

  // The facet at a corner; kNone if something else reaches the corner in the triangle's plane.
  [[nodiscard]] std::uint32_t facet_at(const CornerRay& ray) const {
    const std::uint32_t corner =
        soup_.triangles[TriangleId(ray.triangle)].corners[ray.corner].value;
    std::uint32_t found = kNone;
    std::size_t ends = 0;
    const std::uint32_t last = 3 * sheets_.first[ray.triangle + 1];
    for (std::uint32_t s = 3 * sheets_.first[ray.triangle]; s < last; ++s) {
      if (side_start(sheets_.corners, s) != corner &&
          side_start(sheets_.corners, next_side(s)) != corner) {
        continue;
      }
      found = s / 3;
      if (sheets_.across[s] == kNone) ++ends;
    }
    return ends == 2 ? found : kNone;
  }

  Chambers number() {
    Chambers chambers;
    std::vector<std::uint32_t> number(2 * sheets_.size() + 1, kNone);
    number[sides_.root(outside())] = chambers.count++;
    const auto number_of = [&](std::uint32_t side) {
      std::uint32_t& n = number[sides_.root(side)];
      if (n == kNone) n = chambers.count++;
      return n;
    };
    chambers.front.reserve(sheets_.size());
    chambers.behind.reserve(sheets_.size());
    for (std::uint32_t f = 0; f < sheets_.size(); ++f) {
      chambers.front.push_back(number_of(front(f)));
      chambers.behind.push_back(number_of(behind(f)));
    }
    return chambers;
  }

  const CutSet& cut_;
  const ArrangedPoints& points_;
  const CleanSoup& soup_;
  const Sheets& sheets_;
  const SheetEdges& edges_;
  const Stacks& stacks_;
  CancelCheck check_;
  SharedSets sides_;              // of facets, and the outside
  SharedSets parts_;              // facets that are connected
  std::vector<char> is_reached_;  // of the first facet of each part: a ray told where it lies
  std::size_t axis_ = 2;          // along which rays run
  PlaneTable planes_;             // those of cut triangles, and of rays; empty until needed
};

}  // namespace

std::optional<Chambers> find_chambers(const CutSet& cut, const ArrangedPoints& points,
                                      const Sheets& sheets, const SheetEdges& edges,
                                      const Stacks& stacks, ProgressObserver* progress) {
  return ChamberFinder(cut, points, sheets, edges, stacks, progress).run();
}

}  // namespace meshrepair::internal
