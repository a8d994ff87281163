// SPDX-License-Identifier: MIT
// From the kept facets of an arrangement to the triangles of the result. Facets of one region,
// which lie in one triangle of the input or in several of one plane, become one planar mesh:
// vertices inside the region and inside straight lines go, and what is left is made constrained
// Delaunay. A region that is its whole triangle comes out as that triangle, with its corners in
// their order.
//
// Vertices are not points but fans: corners of facets that are joined one after the other around a
// point. So solids that touch in a point or along an edge have vertices of their own there. Where
// the solid touches itself along an edge, both pairs of facets may share both of its ends, and an
// indexed mesh could not tell the two edges apart: each gets a vertex in its middle. That is tried
// last, as it adds vertices.
//
// Where regions meet, a point is one vertex, and facets of other regions begin at their edges.
//
// Invariant: the result does not depend on the order of tasks. Regions come in the order of the
// triangles that they begin in, and vertices in the order in which triangles use them.
#include "sheet_surface.h"

#include <algorithm>
#include <span>
#include <utility>

#include <base/ids.h>
#include <base/parallel.h>
#include <base/release.h>
#include <base/shared_progress.h>
#include <base/shared_sets.h>

#include "sheet_regions.h"
#include "touching_middles.h"
#include "triangulate/planar_mesh.h"

namespace meshrepair::internal {
namespace {

// Some milliseconds of work.
constexpr std::size_t kFacetsPerTask = 2048;

// A triangle of the surface, by slots that start at its corners.
struct SlotTriangle {
  IndexTriangle slots{};
  std::uint32_t source = kNone;  // a triangle of the cut soup
};

// What all regions have in common.
struct RegionInput {
  const CutSet& cut;
  const ArrangedPoints& points;
  const Sheets& sheets;
  const KeptFacets& kept;
  const SheetRegions& regions;
  // Of a slot, what is the same for all whose corners, at which they start, are one vertex.
  const std::vector<std::uint32_t>& fan;

  [[nodiscard]] std::uint32_t start(std::uint32_t slot) const {
    return side_start(sheets.corners, slot);
  }
};

// Triangulates regions, one after the other.
class RegionMaker {
 public:
  RegionMaker(const RegionInput& input, std::vector<SlotTriangle>& result)
      : in_(input), result_(result), mesh_(input.cut.planes(), false) {}

  // The facets of one region. False where that cannot be.
  bool add(std::span<const std::uint32_t> facets) {
    const std::uint32_t t = in_.sheets.triangle[facets[0]];
    const bool all_of_it = facets.size() == in_.sheets.first[t + 1] - in_.sheets.first[t] &&
                           in_.sheets.triangle[facets.back()] == t;
    if (all_of_it && add_whole(facets, t)) return true;
    return add_mesh(facets);
  }

 private:
  // The triangle itself, if no other point of its outline is needed.
  bool add_whole(std::span<const std::uint32_t> facets, std::uint32_t t) {
    const auto& corners = in_.cut.soup().triangles[TriangleId(t)].corners;
    IndexTriangle fan = {kNone, kNone, kNone};
    for (const std::uint32_t f : facets) {
      for (std::uint32_t s = 3 * f; s < 3 * f + 3; ++s) {
        const std::uint32_t p = in_.start(s);
        const auto k = static_cast<std::size_t>(
            std::find_if(corners.begin(), corners.end(), [&](PointId c) { return c.value == p; }) -
            corners.begin());
        if (k < 3) {
          if (in_.regions.needed[p] == 0) return false;
          fan[k] = s;
        } else if (in_.regions.needed[p] != 0) {
          return false;
        }
      }
    }
    if (in_.kept.kept[facets[0]] == Kept::turned_round) std::swap(fan[1], fan[2]);
    result_.push_back({fan, t});
    return true;
  }

  bool add_mesh(std::span<const std::uint32_t> facets) {
    const std::uint32_t t = in_.sheets.triangle[facets[0]];
    const std::uint32_t number = in_.cut.number_of(t);
    if (number == kNone) return false;
    const bool turned = in_.kept.kept[facets[0]] == Kept::turned_round;
    const int side = in_.cut.side_of(number);
    mesh_.reset(in_.cut.plane(number), turned ? -side : side);
    add_vertices(facets);
    slot_in_mesh_.clear();
    for (std::size_t i = 0; i < facets.size(); ++i) add_facet(facets[i], 3 * i);
    join_facets();
    for (std::uint32_t v = 0; v < corner_.size(); ++v) {
      const bool goes = in_.regions.needed[in_.start(corner_[v])] == 0;
      if (goes && !mesh_.remove_vertex(v)) return false;
    }
    mesh_.improve();
    mesh_.for_each_triangle([&](const auto& corners, const auto& marks) {
      std::uint32_t source = t;
      for (const std::uint32_t mark : marks) {
        if (mark == kNone) continue;
        source = in_.sheets.triangle[mark / 3];
        break;
      }
      result_.push_back({{corner_[corners[0]], corner_[corners[1]], corner_[corners[2]]}, source});
    });
    return true;
  }

  // One for each fan, in the order in which these come first.
  void add_vertices(std::span<const std::uint32_t> facets) {
    const std::size_t slots = 3 * facets.size();
    const auto slot_at = [&](std::size_t i) {
      return 3 * facets[i / 3] + static_cast<std::uint32_t>(i % 3);
    };
    by_fan_.clear();
    for (std::uint32_t i = 0; i < slots; ++i) by_fan_.push_back({in_.fan[slot_at(i)], i});
    std::sort(by_fan_.begin(), by_fan_.end());
    vertex_.assign(slots, kNone);
    for (std::size_t i = 0; i < slots; ++i) {  // for the time being, where its fan comes first
      const bool is_first = i == 0 || by_fan_[i].first != by_fan_[i - 1].first;
      const std::uint32_t at = by_fan_[i].second;
      vertex_[at] = is_first ? at : vertex_[by_fan_[i - 1].second];
    }
    at_.clear();
    at_.reserve(slots);
    corner_.clear();
    for (std::uint32_t i = 0; i < slots; ++i) {
      if (vertex_[i] != i) {
        vertex_[i] = vertex_[vertex_[i]];
        continue;
      }
      at_.push_back(in_.points.at(in_.start(slot_at(i))));
      vertex_[i] = mesh_.add_vertex(at_.back());
      corner_.push_back(slot_at(i));
    }
  }

  void add_facet(std::uint32_t f, std::size_t first_slot) {
    IndexTriangle vertices = {vertex_[first_slot], vertex_[first_slot + 1],
                              vertex_[first_slot + 2]};
    const bool turned = in_.kept.kept[f] == Kept::turned_round;
    if (turned) std::swap(vertices[1], vertices[2]);
    const std::uint32_t first = 3 * mesh_.add_triangle(vertices);
    // Turned round, sides 0, 1 and 2 are the last, the middle and the first one.
    for (std::uint32_t k = 0; k < 3; ++k) {
      slot_in_mesh_.push_back({3 * f + k, first + (turned ? 2 - k : k)});
    }
  }

  // The slots of facets are in ascending order.
  void join_facets() {
    for (const auto& [s, slot] : slot_in_mesh_) {
      if (in_.regions.dissolved[s] == 0) {
        mesh_.mark(slot, s);
        continue;
      }
      const std::uint32_t mate = in_.kept.mate[s];
      if (mate < s) continue;
      const auto other =
          std::lower_bound(slot_in_mesh_.begin(), slot_in_mesh_.end(), std::pair(mate, 0u));
      mesh_.join(slot, other->second);
    }
  }

  const RegionInput& in_;
  std::vector<SlotTriangle>& result_;
  // Of one region.
  PlanarMesh mesh_;
  std::vector<Point> at_;
  std::vector<std::uint32_t> corner_;  // of each vertex a slot that starts there
  std::vector<std::uint32_t> vertex_;  // of each slot
  std::vector<std::pair<std::uint32_t, std::uint32_t>> slot_in_mesh_, by_fan_;
};

class SheetSurfaceMaker {
 public:
  SheetSurfaceMaker(const CutSet& cut, const ArrangedPoints& points, const Sheets& sheets,
                    const KeptFacets& kept, SheetRegions regions, const ExtractOptions& options,
                    ArrangeReport& report)
      : cut_(cut),
        points_(points),
        sheets_(sheets),
        kept_(kept),
        regions_(std::move(regions)),
        report_(report),
        may_touch_itself_(options.may_touch_itself),
        quiet_(options.progress) {
    find_fans();
  }

  // To be called before run(): fans of one point are one vertex.
  void join_fans() { are_fans_joined_ = true; }
  // Of each triangle of the result a facet of its region; to be called once run() is done.
  [[nodiscard]] std::vector<std::uint32_t> facets() { return std::move(facet_); }

  // To be called before run(): edges along which the solid touches itself get middles. All of them
  // have to be in outlines.
  void find_middles(const SheetEdges& edges) {
    middles_ = TouchingMiddles(edges, kept_, regions_, fan_);
    report_.middle_vertices = middles_.size();
  }

  std::optional<Surface> run() {
    list_regions();
    if (!make_regions()) return std::nullopt;
    number_points();
    place_points();
    if (!may_touch_itself_ && !are_fans_joined_ && !is_manifold()) return std::nullopt;
    return std::move(surface_);
  }

 private:
  [[nodiscard]] std::uint32_t region_of(std::uint32_t f) const { return regions_.region[f]; }
  [[nodiscard]] std::uint32_t start(std::uint32_t slot) const {
    return side_start(sheets_.corners, slot);
  }

  // Corners of facets that are joined are one vertex.
  void find_fans() {
    SharedSets fans(kept_.mate.size());
    const auto join = [&](std::uint32_t s) {
      const std::uint32_t m = kept_.mate[s];
      if (m == kNone || m < s) return;
      if (kept_.is_between_regions && kept_.singular[s] != 0) return;
      if (start(s) == start(m)) {
        fans.join(s, m);
        fans.join(next_side(s), next_side(m));
      } else {
        fans.join(s, next_side(m));
        fans.join(next_side(s), m);
      }
    };
    parallel_for(kept_.mate.size(), [&](std::size_t s) { join(static_cast<std::uint32_t>(s)); });
    fan_.resize(kept_.mate.size());
    parallel_for(fan_.size(),
                 [&](std::size_t s) { fan_[s] = fans.root(static_cast<std::uint32_t>(s)); });
  }

  // Facets by their regions, those in the order of the triangle that they begin in.
  void list_regions() {
    for (std::uint32_t f = 0; f < sheets_.size(); ++f) {
      if (kept_.kept[f] != Kept::no) order_.push_back(f);
    }
    parallel_sort(order_.begin(), order_.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return region_of(a) < region_of(b); });
  }

  // Each task takes the regions that begin among its facets.
  bool make_regions() {
    const RegionInput input = {cut_, points_, sheets_, kept_, regions_, fan_};
    struct Made {
      std::vector<SlotTriangle> triangles;
      std::size_t regions = 0;
      bool all = true;
    };
    const auto begins = [&](std::size_t i) {
      return i == 0 || i == order_.size() || region_of(order_[i]) != region_of(order_[i - 1]);
    };
    SharedProgress progress(&quiet_, tasks_of(order_.size(), kFacetsPerTask));
    const auto make = [&](std::size_t first, std::size_t last) {
      Made made;
      RegionMaker maker(input, made.triangles);
      std::size_t i = first;
      while (!begins(i)) ++i;
      while (i < last && made.all) {
        std::size_t end = i + 1;
        while (!begins(end)) ++end;
        made.all = maker.add(std::span(order_).subspan(i, end - i));
        ++made.regions;
        i = end;
      }
      progress.done();
      return made;
    };
    bool all = true;
    parallel_reduce(order_.size(), kFacetsPerTask, make, [&](Made&, const Made& made) {
      triangles_.insert(triangles_.end(), made.triangles.begin(), made.triangles.end());
      report_.regions += made.regions;
      all = all && made.all;
    });
    release(order_);
    return all;
  }

  // In the order in which triangles have them.
  void number_points() {
    // Of a fan, or of a point, its point of the surface.
    std::vector<std::uint32_t> vertex(are_fans_joined_ ? points_.size() : fan_.size(), kNone);
    std::vector<std::uint32_t> middle_vertex(middles_.size(), kNone);
    surface_.mesh.triangles.reserve(triangles_.size());
    surface_.source.reserve(triangles_.size());
    for (const SlotTriangle& triangle : triangles_) {
      IndexTriangle corners{};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t slot = triangle.slots[k];
        std::uint32_t& number = vertex[are_fans_joined_ ? start(slot) : fan_[slot]];
        if (number == kNone) {
          number = static_cast<std::uint32_t>(point_.size());
          point_.push_back(start(slot));
        }
        corners[k] = number;
      }
      if (middles_.size() == 0) {
        surface_.mesh.triangles.push_back(corners);
      } else {
        split_at_middles(corners, middles_of(triangle, corners, middle_vertex),
                         surface_.mesh.triangles);
      }
      static_assert(Surface::kNoSource == Triangle::kNoSource);
      surface_.source.resize(surface_.mesh.triangles.size(),
                             cut_.soup().triangles[TriangleId(triangle.source)].source);
      if (are_fans_joined_) facet_.push_back(triangle.slots[0] / 3);
    }
    release(triangles_);
  }

  IndexTriangle middles_of(const SlotTriangle& triangle, const IndexTriangle& corners,
                           std::vector<std::uint32_t>& middle_vertex) {
    IndexTriangle middles = {kNone, kNone, kNone};
    const std::uint32_t region = region_of(triangle.slots[0] / 3);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      const std::uint32_t middle =
          middles_.find(region, fan_[triangle.slots[k]], fan_[triangle.slots[next]]);
      if (middle == kNone) continue;
      std::uint32_t& number = middle_vertex[middle];
      if (number == kNone) {
        number = static_cast<std::uint32_t>(point_.size());
        point_.push_back(kNone);
        between_.push_back({number, corners[k], corners[next]});
      }
      middles[k] = number;
    }
    return middles;
  }

  void place_points() {
    const CleanSoup& soup = cut_.soup();
    surface_.mesh.points.resize(point_.size());
    surface_.input_point.resize(point_.size());
    parallel_for(point_.size(), [&](std::size_t i) {
      const std::uint32_t p = point_[i];
      if (p == kNone) return;
      const bool of_input = p < points_.first_new();
      surface_.mesh.points[i] =
          of_input ? soup.points[PointId(p)]
                   : soup.grid.from_grid(accurate_position(points_.at(p), cut_.planes()));
      surface_.input_point[i] = of_input ? 1 : 0;
    });
    std::vector<Vec3d>& points = surface_.mesh.points;
    // Halves first: the sum may be beyond the numbers.
    for (const auto& [middle, a, b] : between_) points[middle] = 0.5 * points[a] + 0.5 * points[b];
  }

  // Whether each edge has two triangles that pass it in opposite directions.
  [[nodiscard]] bool is_manifold() const {
    const auto& triangles = surface_.mesh.triangles;
    bool manifold = true;
    EdgeTable(triangles).for_each_edge([&](std::span<const std::uint32_t> sides) {
      manifold = manifold && sides.size() == 2 &&
                 side_start(triangles, sides[0]) != side_start(triangles, sides[1]);
    });
    return manifold;
  }

  const CutSet& cut_;
  const ArrangedPoints& points_;
  const Sheets& sheets_;
  const KeptFacets& kept_;
  const SheetRegions regions_;
  ArrangeReport& report_;
  bool may_touch_itself_, are_fans_joined_ = false;
  CancelOnly quiet_;
  std::vector<std::uint32_t> fan_;    // of each slot the lowest one of its fan
  std::vector<std::uint32_t> order_;  // facets by their regions
  std::vector<SlotTriangle> triangles_;
  std::vector<std::uint32_t> facet_;
  // Of each point of the surface, that of the arrangement; kNone for middles.
  std::vector<std::uint32_t> point_;
  TouchingMiddles middles_;
  std::vector<IndexTriangle> between_;  // middles, and which two points each is between
  Surface surface_;
};

}  // namespace

std::optional<Surface> make_sheet_surface(const CutSet& cut, const ArrangedPoints& points,
                                          const Sheets& sheets, const SheetEdges& edges,
                                          const KeptFacets& kept, const ExtractOptions& options,
                                          ArrangeReport& report) {
  for (const bool releases_touching : {true, false}) {
    report.regions = report.middle_vertices = 0;
    SheetRegions regions = merge_sheets(cut, points, sheets, edges, kept,
                                        {releases_touching, options.merges_triangles});
    SheetSurfaceMaker maker(cut, points, sheets, kept, std::move(regions), options, report);
    if (!releases_touching) maker.find_middles(edges);
    std::optional<Surface> surface = maker.run();
    if (surface || kept.singular_edges == 0) return surface;
  }
  return std::nullopt;
}

// Nothing is merged.
SheetRegions single_facets(const Sheets& sheets, const KeptFacets& kept, std::size_t points) {
  SheetRegions regions;
  regions.region.resize(sheets.size(), kNone);
  for (std::uint32_t f = 0; f < sheets.size(); ++f) {
    if (kept.kept[f] != Kept::no) regions.region[f] = f;
  }
  regions.dissolved.assign(3 * sheets.size(), 0);
  regions.needed.assign(points, 1);
  return regions;
}

std::optional<SheetFaces> make_sheet_faces(const CutSet& cut, const ArrangedPoints& points,
                                           const Sheets& sheets, const SheetEdges& edges,
                                           const KeptFacets& kept, ProgressObserver* progress) {
  ExtractOptions options;
  options.progress = progress;
  for (const bool merges : {true, false}) {
    SheetRegions regions = merges ? merge_sheets(cut, points, sheets, edges, kept, {})
                                  : single_facets(sheets, kept, points.size());
    ArrangeReport report;
    SheetSurfaceMaker maker(cut, points, sheets, kept, std::move(regions), options, report);
    maker.join_fans();
    if (auto surface = maker.run()) return SheetFaces{std::move(*surface), maker.facets()};
  }
  return std::nullopt;
}

}  // namespace meshrepair::internal
