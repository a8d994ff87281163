// SPDX-License-Identifier: MIT
// A surface with two sides is there twice, once facing each way, and winds around nothing. Where
// both copies have the same triangles, clean_soup() joins them. Here are those that do not: cut
// along other diagonals, and apart by rounding.
//
// join_cuts() compares faces, not triangles. A face is what edges at which the surface does not
// simply go on bound, nearly flat and without corners inside; its name is its outline. Faces of one
// name as many of which face either way become one set of triangles that winds around nothing.
//
// bring_layers_together() joins points that are apart by rounding, looks where that makes two
// layers one, and keeps the moves there alone. Corners of one triangle that would become one are a
// wall between the layers: then these are a thin solid.
//
// Both ask whether most of a part is there twice. Two pieces of a surface that lie on each other
// somewhere do so by chance, and stay.
#include "two_layers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

#include <base/disjoint_sets.h>
#include <base/ids.h>
#include <base/internal/hash_index.h>
#include <bsp/common_grid.h>
#include <mesh/edge_table.h>
#include <mesh/internal/triangle_measures.h>
#include <mesh/topology.h>
#include <repair/orient_parts.h>

#include "open/open_sheets.h"

namespace meshrepair::internal {
namespace {

// Of the area of a face, at least, the length of its vector area: corners of a quad may lie off
// its plane by a fifth of its width.
constexpr double kNearlyFlat = 0.9;

// Of the angle between two triangles: 45 degrees, as quads need not be flat.
constexpr double kLyingOnEachOther = 0.7;

// Of the area of a part, what copies of faces have to be for it to have two sides.
constexpr double kLeastOfPart = 0.4;

// In grid steps: layers whose corners are farther apart are two surfaces. Of the input's own
// rounding, so many are as near.
constexpr double kNearLayers = 64;
constexpr double kRoundings = 8;

// Edges between the same places as a triangle's corners, whatever its direction.
using Outline = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

struct Face {
  std::vector<std::uint32_t> triangles;
  Outline outline;  // sorted
  Vec3d vector_area = Vec3d::Zero();
  double area = 0;
};

Vec3d vector_area_of(const CleanSoup& soup, TriangleId t) {
  const auto& c = soup.triangles[t].corners;
  const Vec3d a = as_vector(soup.grid_points[c[0]]);
  return (as_vector(soup.grid_points[c[1]]) - a).cross(as_vector(soup.grid_points[c[2]]) - a);
}

// What may have copies that are cut otherwise.
class FaceFinder {
 public:
  FaceFinder(const CleanSoup& soup, ProgressObserver* progress)
      : soup_(soup),
        check_(progress),
        triangles_(index_triangles(soup)),
        sets_(triangles_.size()) {}

  std::vector<Face> run() {
    const EdgeTable table(triangles_);
    table.for_each_edge([&](std::span<const std::uint32_t> sides) {
      if (go_on_across(sides)) sets_.join(sides[0] / 3, sides[1] / 3);
    });
    face_of_.assign(triangles_.size(), kNone);
    table.for_each_edge([&](std::span<const std::uint32_t> sides) {
      check_.tick();
      if (sides.size() < 2 || go_on_across(sides)) return;
      for (const std::uint32_t side : sides) add_edge(side);
    });
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      const std::uint32_t f = face_of_[sets_.root(t)];
      if (f == kNone) continue;
      const Vec3d area = vector_area_of(soup_, TriangleId(t));
      faces_[f].triangles.push_back(t);
      faces_[f].vector_area += area;
      faces_[f].area += area.norm();
    }
    std::erase_if(faces_, [](const Face& face) { return !may_have_copies(face); });
    for (Face& face : faces_) std::sort(face.outline.begin(), face.outline.end());
    std::stable_sort(faces_.begin(), faces_.end(),
                     [](const Face& a, const Face& b) { return a.outline < b.outline; });
    return std::move(faces_);
  }

 private:
  // Whether the surface goes on across the edge. At an edge of three or more triangles there may be
  // copies, and at one of two that lie on each other, as the rim of a sheet with two sides.
  [[nodiscard]] bool go_on_across(std::span<const std::uint32_t> sides) const {
    if (sides.size() != 2) return false;
    const auto at = [&](std::uint32_t side) {
      return as_vector(soup_.grid_points[PointId(side_start(triangles_, side))]);
    };
    const std::uint32_t a = sides[0], b = sides[1];
    return fold_cosine(at(a), at(next_side(a)), at(next_side(next_side(a))),
                       at(next_side(next_side(b)))) < kLyingOnEachOther;
  }

  void add_edge(std::uint32_t side) {
    std::uint32_t& face = face_of_[sets_.root(side / 3)];
    if (face == kNone) {
      face = static_cast<std::uint32_t>(faces_.size());
      faces_.emplace_back();
    }
    const std::uint32_t a = side_start(triangles_, side);
    const std::uint32_t b = side_start(triangles_, next_side(side));
    faces_[face].outline.emplace_back(std::min(a, b), std::max(a, b));
  }

  // A triangle has one cut only; with corners inside, or open edges, there are more triangles than
  // the outline tells.
  static bool may_have_copies(const Face& face) {
    return face.triangles.size() > 1 && face.outline.size() == face.triangles.size() + 2 &&
           face.vector_area.norm() >= kNearlyFlat * face.area;
  }

  const CleanSoup& soup_;
  CancelCheck check_;
  std::vector<IndexTriangle> triangles_;
  DisjointSets sets_;
  std::vector<std::uint32_t> face_of_;  // of each root
  std::vector<Face> faces_;
};

// Points in cells that are much wider than points may be apart, so that most look into one.
class NearPoints {
 public:
  explicit NearPoints(double distance) : distance_(distance) {}

  // The first of the points before that is within the distance; else itself, which is added.
  PointId first_near(PointId point, const GridPoint& at) {
    const Cell low = cell_of(as_vector(at).array() - distance_);
    const Cell high = cell_of(as_vector(at).array() + distance_);
    PointId best;
    for (std::int32_t x = low[0]; x <= high[0]; ++x) {
      for (std::int32_t y = low[1]; y <= high[1]; ++y) {
        for (std::int32_t z = low[2]; z <= high[2]; ++z) look_into({x, y, z}, at, best);
      }
    }
    if (best.valid()) return best;
    add(point, at);
    return point;
  }

 private:
  static constexpr double kWidth = 16;
  using Cell = std::array<std::int32_t, 3>;
  struct Entry {
    GridPoint at;
    PointId point;
    std::uint32_t next;  // in the same cell
  };

  [[nodiscard]] Cell cell_of(const Vec3d& place) const {
    const auto along = [&](double x) {
      return static_cast<std::int32_t>(std::floor(x / (kWidth * distance_)));
    };
    return {along(place.x()), along(place.y()), along(place.z())};
  }

  static std::uint64_t hash_of(const Cell& cell) {
    std::uint64_t h = 0;
    for (const std::int32_t x : cell) h = hash_mix(h, static_cast<std::uint32_t>(x));
    return h;
  }

  void look_into(const Cell& cell, const GridPoint& at, PointId& best) const {
    const std::uint32_t c =
        index_.find(hash_of(cell), [&](std::uint32_t k) { return cells_[k].first == cell; });
    if (c == kNone) return;
    for (std::uint32_t e = cells_[c].second; e != kNone; e = entries_[e].next) {
      if ((as_vector(entries_[e].at) - as_vector(at)).norm() > distance_) continue;
      if (!best.valid() || entries_[e].point < best) best = entries_[e].point;
    }
  }

  void add(PointId point, const GridPoint& at) {
    if (index_.full(cells_.size())) {
      index_.grow(static_cast<std::uint32_t>(cells_.size()),
                  [&](std::uint32_t k) { return hash_of(cells_[k].first); });
    }
    const Cell cell = cell_of(as_vector(at));
    const auto fresh = static_cast<std::uint32_t>(cells_.size());
    const std::uint32_t c = index_.find_or_insert(
        hash_of(cell), fresh, [&](std::uint32_t k) { return cells_[k].first == cell; });
    if (c == fresh) cells_.emplace_back(cell, kNone);
    entries_.push_back({at, point, cells_[c].second});
    cells_[c].second = static_cast<std::uint32_t>(entries_.size() - 1);
  }

  double distance_;
  std::vector<Entry> entries_;
  std::vector<std::pair<Cell, std::uint32_t>> cells_;  // with the last entry in each
  HashIndex index_{1024};
};

// The points that become one with another, by the first of them.
using Firsts = IdVector<PointId, PointId>;

Firsts find_firsts(const CleanSoup& clean, CancelCheck& check) {
  NearPoints near(std::max(kNearLayers, kRoundings * rounding_of(clean)));
  Firsts firsts;
  firsts.reserve(clean.points.size());
  for (PointId p(0u); p < clean.points.end_id(); ++p.value) {
    check.tick();
    firsts.push_back(near.first_near(p, clean.grid_points[p]));
  }
  return firsts;
}

bool any_joined(const Firsts& firsts, const std::vector<char>& chosen) {
  for (PointId p(0u); p < firsts.end_id(); ++p.value) {
    if (firsts[p] != p && chosen[firsts[p].index()] != 0) return true;
  }
  return false;
}

// Where the points of a soup are on its grid.
class PointsOnGrid {
 public:
  explicit PointsOnGrid(const CleanSoup& clean) : clean_(clean), index_(clean.points.size()) {
    for (std::uint32_t p = 0; p < clean.points.size(); ++p) {
      (void)index_.find_or_insert(hash_of(at(p)), p, [](std::uint32_t) { return false; });
    }
  }

  // Invalid where it is none of the clean soup's.
  [[nodiscard]] PointId find(const Vec3d& place) const {
    if (!place.allFinite()) return {};
    const GridPoint there = clean_.grid.to_grid(place);
    const std::uint32_t p =
        index_.find(hash_of(there), [&](std::uint32_t k) { return at(k) == there; });
    return p == kNone ? PointId() : PointId(p);
  }

 private:
  [[nodiscard]] const GridPoint& at(std::uint32_t p) const {
    return clean_.grid_points[PointId(p)];
  }
  static std::uint64_t hash_of(const GridPoint& p) {
    const auto part = [](std::int32_t x) { return std::uint64_t{static_cast<std::uint32_t>(x)}; };
    return hash_mix(hash_mix(0, part(p.x) << 32 | part(p.y)), part(p.z));
  }

  const CleanSoup& clean_;
  HashIndex index_;
};

// Moves all points to those of the first ones that are chosen, also those in one place on the grid
// with them, which may be another one on the next grid.
TriangleSoup moved_to_firsts(const TriangleSoup& soup, const CleanSoup& clean,
                             const PointsOnGrid& on_grid, const Firsts& firsts,
                             const std::vector<char>& chosen) {
  TriangleSoup moved = soup;
  for (Vec3d& place : moved.points) {
    const PointId p = on_grid.find(place);
    if (p.valid() && chosen[firsts[p].index()] != 0) place = clean.points[firsts[p]];
  }
  return moved;
}

// A surface with two sides has them nearly everywhere. Elsewhere two pieces of a surface lie on
// each other by chance, and are left as they are. What is there both ways round is known.
class PartsOnBothSides {
 public:
  explicit PartsOnBothSides(const CleanSoup& soup)
      : part_of_(parts_of(soup)), area_(part_of_.size(), 0), doubled_(part_of_.size(), 0) {
    for (TriangleId t(0u); t < soup.triangles.end_id(); ++t.value) {
      const double area = vector_area_of(soup, t).norm();
      area_[part_of(t)] += area;
      if (soup.triangles[t].winding == 0) add_doubled(t, area);
    }
  }

  void add_doubled(TriangleId t, double area) { doubled_[part_of(t)] += area; }
  void leave_out_part_of(TriangleId t) { doubled_[part_of(t)] = 0; }
  [[nodiscard]] bool has_both(TriangleId t) const {
    return doubled_[part_of(t)] >= kLeastOfPart * area_[part_of(t)];
  }

 private:
  static std::vector<std::uint32_t> parts_of(const CleanSoup& soup) {
    TopologyPlaces places;
    (void)examine_topology(index_triangles(soup), soup.points.size(), &places);
    return std::move(places.parts);
  }
  [[nodiscard]] std::uint32_t part_of(TriangleId t) const { return part_of_[t.index()]; }

  std::vector<std::uint32_t> part_of_;
  std::vector<double> area_, doubled_;  // of each part
};

// Of each point, whether corners of one triangle became one there: of a wall between two layers.
std::vector<char> points_of_walls(const CleanSoup& clean, const Firsts& firsts) {
  std::vector<char> is_of_wall(clean.points.size(), 0);
  for (const Triangle& t : clean.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const PointId a = firsts[t.corners[k]], b = firsts[t.corners[(k + 1) % 3]];
      if (a == b) is_of_wall[a.index()] = 1;
    }
  }
  return is_of_wall;
}

// Of each point, whether it is a corner of faces that are there both ways round; not where walls
// between the layers make them a solid, however thin.
std::vector<char> points_on_both_layers(const CleanSoup& joined, const CleanSoup& clean,
                                        const PointsOnGrid& on_grid, const Firsts& firsts) {
  const auto is_doubled = [&](TriangleId t) { return joined.triangles[t].winding == 0; };
  PartsOnBothSides parts(joined);
  const auto for_each_point = [&](TriangleId t, auto&& look_at) {
    for (const PointId corner : joined.triangles[t].corners) {
      const PointId p = on_grid.find(joined.points[corner]);
      if (p.valid()) look_at(p.index());
    }
  };
  const std::vector<char> is_of_wall = points_of_walls(clean, firsts);
  for (TriangleId t(0u); t < joined.triangles.end_id(); ++t.value) {
    for_each_point(t, [&](std::size_t p) {
      if (is_of_wall[p] != 0) parts.leave_out_part_of(t);
    });
  }
  std::vector<char> is_on_both(clean.points.size(), 0);
  for (TriangleId t(0u); t < joined.triangles.end_id(); ++t.value) {
    if (!is_doubled(t) || !parts.has_both(t)) continue;
    for_each_point(t, [&](std::size_t p) { is_on_both[p] = 1; });
  }
  return is_on_both;
}

// Faces with one outline: those from first on, before last.
struct Copies {
  std::uint32_t first, last;
};

// Of all together, in the direction of the first; nothing where a face winds otherwise in one place
// than in another.
std::optional<std::int32_t> winding_of(const CleanSoup& soup, const std::vector<Face>& faces,
                                       const Copies& copies) {
  std::int32_t sum = 0;
  for (std::uint32_t f = copies.first; f < copies.last; ++f) {
    const auto winding = [&](std::uint32_t t) {
      const Triangle& triangle = soup.triangles[TriangleId(t)];
      const std::int32_t count = std::abs(triangle.winding) * triangle.layers;
      return vector_area_of(soup, TriangleId(t)).dot(faces[copies.first].vector_area) > 0 ? count
                                                                                          : -count;
    };
    const std::vector<std::uint32_t>& triangles = faces[f].triangles;
    const std::int32_t first = winding(triangles.front());
    if (std::any_of(triangles.begin(), triangles.end(),
                    [&](std::uint32_t t) { return winding(t) != first; })) {
      return std::nullopt;
    }
    sum += first;
  }
  return sum;
}

void drop_copies_of_little(const CleanSoup& soup, const std::vector<Face>& faces,
                           std::vector<Copies>& copies) {
  if (copies.empty()) return;
  PartsOnBothSides parts(soup);
  const auto some_triangle = [&](const Copies& c) {
    return TriangleId(faces[c.first].triangles.front());
  };
  for (const Copies& c : copies) {
    for (std::uint32_t f = c.first; f < c.last; ++f) {
      parts.add_doubled(some_triangle(c), faces[f].area);
    }
  }
  std::erase_if(copies, [&](const Copies& c) { return !parts.has_both(some_triangle(c)); });
}

}  // namespace

void join_cuts(CleanSoup& soup, ProgressObserver* progress) {
  const std::vector<Face> faces = FaceFinder(soup, progress).run();
  std::vector<Copies> copies;
  for (std::uint32_t first = 0, last = 0; first < faces.size(); first = last) {
    for (last = first + 1; last < faces.size() && faces[last].outline == faces[first].outline;) {
      ++last;
    }
    if (last > first + 1 && winding_of(soup, faces, {first, last}) == 0) {
      copies.push_back({first, last});
    }
  }
  drop_copies_of_little(soup, faces, copies);
  std::vector<char> dropped(soup.triangles.size(), 0);
  for (const auto& [first, last] : copies) {
    for (const std::uint32_t t : faces[first].triangles) soup.triangles[TriangleId(t)].winding = 0;
    for (std::uint32_t f = first + 1; f < last; ++f) {
      for (const std::uint32_t t : faces[f].triangles) dropped[t] = 1;
    }
  }
  std::size_t kept = 0;
  for (std::size_t t = 0; t < dropped.size(); ++t) {
    if (dropped[t] == 0) soup.triangles[TriangleId(kept++)] = soup.triangles[TriangleId(t)];
  }
  soup.triangles.resize(kept);
}

std::optional<TriangleSoup> bring_layers_together(const TriangleSoup& soup, const CleanSoup& clean,
                                                  ProgressObserver* progress) {
  CancelCheck check(progress);
  const Firsts firsts = find_firsts(clean, check);
  std::vector<char> chosen(clean.points.size(), 1);
  if (!any_joined(firsts, chosen)) return std::nullopt;
  const PointsOnGrid on_grid(clean);
  CleanReport report;
  CleanSoup joined = clean_soup(moved_to_firsts(soup, clean, on_grid, firsts, chosen), clean.grid,
                                report, progress);
  join_cuts(joined, progress);
  chosen = points_on_both_layers(joined, clean, on_grid, firsts);
  if (!any_joined(firsts, chosen)) return std::nullopt;
  return moved_to_firsts(soup, clean, on_grid, firsts, chosen);
}

}  // namespace meshrepair::internal
