#include "sheet_surface.h"

#include <algorithm>
#include <span>
#include <utility>

#include <base/disjoint_sets.h>
#include <base/ids.h>

#include "sheet_regions.h"
#include "triangulate/planar_mesh.h"

namespace meshrepair::internal {
namespace {

class SheetSurfaceMaker {
 public:
  SheetSurfaceMaker(const CutSet& cut, const ArrangedPoints& points, const Sheets& sheets,
                    const KeptFacets& kept, SheetRegions regions, ArrangeReport& report,
                    ProgressObserver* progress)
      : cut_(cut),
        points_(points),
        sheets_(sheets),
        kept_(kept),
        regions_(std::move(regions)),
        report_(report),
        check_(progress),
        fans_(3 * sheets.size()),
        mesh_(cut.planes(), false) {}

  std::optional<Surface> run() {
    join_fans();
    list_regions();
    local_.assign(3 * sheets_.size(), kNone);
    vertex_.assign(3 * sheets_.size(), kNone);
    for (std::size_t i = 0; i < order_.size();) {
      check_.tick();
      std::size_t end = i + 1;
      while (end < order_.size() && region_of(order_[end]) == region_of(order_[i])) ++end;
      if (!add_region(std::span(order_).subspan(i, end - i))) return std::nullopt;
      ++report_.regions;
      i = end;
    }
    if (!is_manifold()) return std::nullopt;
    return std::move(surface_);
  }

 private:
  [[nodiscard]] std::uint32_t region_of(std::uint32_t f) const { return regions_.region[f]; }
  [[nodiscard]] std::uint32_t start(std::uint32_t slot) const {
    return side_start(sheets_.corners, slot);
  }

  // Corners of facets that are joined are one vertex.
  void join_fans() {
    for (std::uint32_t s = 0; s < kept_.mate.size(); ++s) {
      const std::uint32_t m = kept_.mate[s];
      if (m == kNone || m < s) continue;
      if (start(s) == start(m)) {
        fans_.join(s, m);
        fans_.join(next_side(s), next_side(m));
      } else {
        fans_.join(s, next_side(m));
        fans_.join(next_side(s), m);
      }
    }
  }

  // Facets by their regions, those in the order of the triangle that they begin in.
  void list_regions() {
    for (std::uint32_t f = 0; f < sheets_.size(); ++f) {
      if (kept_.kept[f] != Kept::no) order_.push_back(f);
    }
    std::stable_sort(order_.begin(), order_.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return region_of(a) < region_of(b); });
  }

  bool add_region(std::span<const std::uint32_t> facets) {
    const std::uint32_t t = sheets_.triangle[facets[0]];
    const bool all_of_it = facets.size() == sheets_.first[t + 1] - sheets_.first[t] &&
                           sheets_.triangle[facets.back()] == t;
    if (all_of_it && add_whole(facets, t)) return true;
    return add_mesh(facets);
  }

  // The triangle itself, if no other point of its outline is needed.
  bool add_whole(std::span<const std::uint32_t> facets, std::uint32_t t) {
    const auto& corners = cut_.soup().triangles[TriangleId(t)].corners;
    std::array<std::uint32_t, 3> fan = {kNone, kNone, kNone};
    for (const std::uint32_t f : facets) {
      for (std::uint32_t s = 3 * f; s < 3 * f + 3; ++s) {
        const std::uint32_t p = start(s);
        const auto k = static_cast<std::size_t>(
            std::find_if(corners.begin(), corners.end(), [&](PointId c) { return c.value == p; }) -
            corners.begin());
        if (k < 3) {
          if (regions_.needed[p] == 0) return false;
          fan[k] = s;
        } else if (regions_.needed[p] != 0) {
          return false;
        }
      }
    }
    if (kept_.kept[facets[0]] == Kept::turned_round) std::swap(fan[1], fan[2]);
    add_triangle(fan, t);
    return true;
  }

  bool add_mesh(std::span<const std::uint32_t> facets) {
    const std::uint32_t t = sheets_.triangle[facets[0]];
    const std::uint32_t number = cut_.number_of(t);
    if (number == kNone) return false;
    const bool turned = kept_.kept[facets[0]] == Kept::turned_round;
    mesh_.reset(cut_.plane(number), turned ? -cut_.side_of(number) : cut_.side_of(number));
    at_.clear();
    at_.reserve(3 * facets.size());
    corner_.clear();
    slot_in_mesh_.clear();
    for (const std::uint32_t f : facets) add_facet(f);
    join_facets();
    bool done = true;
    for (std::uint32_t v = 0; v < corner_.size() && done; ++v) {
      if (regions_.needed[start(corner_[v])] == 0) done = mesh_.remove_vertex(v);
    }
    for (const std::uint32_t s : corner_) local_[fans_.root(s)] = kNone;
    if (!done) return false;
    mesh_.improve();
    mesh_.for_each_triangle([&](const auto& corners, const auto& marks) {
      std::uint32_t source = t;
      for (const std::uint32_t mark : marks) {
        if (mark == kNone) continue;
        source = sheets_.triangle[mark / 3];
        break;
      }
      add_triangle({corner_[corners[0]], corner_[corners[1]], corner_[corners[2]]}, source);
    });
    return true;
  }

  void add_facet(std::uint32_t f) {
    std::array<std::uint32_t, 3> vertices{};
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t s = 3 * f + k;
      std::uint32_t& local = local_[fans_.root(s)];
      if (local == kNone) {
        at_.push_back(points_.at(start(s)));
        local = mesh_.add_vertex(at_.back());
        corner_.push_back(s);
      }
      vertices[k] = local;
    }
    const bool turned = kept_.kept[f] == Kept::turned_round;
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
      if (regions_.dissolved[s] == 0) {
        mesh_.mark(slot, s);
        continue;
      }
      const std::uint32_t mate = kept_.mate[s];
      if (mate < s) continue;
      const auto other =
          std::lower_bound(slot_in_mesh_.begin(), slot_in_mesh_.end(), std::pair(mate, 0u));
      mesh_.join(slot, other->second);
    }
  }

  // By slots that start at its corners.
  void add_triangle(const std::array<std::uint32_t, 3>& corners, std::uint32_t triangle) {
    IndexTriangle result{};
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& vertex = vertex_[fans_.root(corners[k])];
      if (vertex == kNone) vertex = add_point(start(corners[k]));
      result[k] = vertex;
    }
    surface_.mesh.triangles.push_back(result);
    static_assert(Surface::kNoSource == Triangle::kNoSource);
    surface_.source.push_back(cut_.soup().triangles[TriangleId(triangle)].source);
  }

  std::uint32_t add_point(std::uint32_t p) {
    const CleanSoup& soup = cut_.soup();
    const bool of_input = p < points_.first_new();
    surface_.mesh.points.push_back(
        of_input ? soup.points[PointId(p)]
                 : soup.grid.from_grid(accurate_position(points_.at(p), cut_.planes())));
    surface_.input_point.push_back(of_input ? 1 : 0);
    return static_cast<std::uint32_t>(surface_.mesh.points.size() - 1);
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
  CancelCheck check_;
  DisjointSets fans_;  // of slots, by the corners that they start at
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> local_;   // of a fan: its vertex in the mesh of a region
  std::vector<std::uint32_t> vertex_;  // of a fan: its point of the surface
  Surface surface_;
  // Of one region.
  PlanarMesh mesh_;
  std::vector<Point> at_;
  std::vector<std::uint32_t> corner_;  // of each vertex a slot that starts there
  std::vector<std::pair<std::uint32_t, std::uint32_t>> slot_in_mesh_;
};

}  // namespace

std::optional<Surface> make_sheet_surface(const CutSet& cut, const ArrangedPoints& points,
                                          const Sheets& sheets, const SheetEdges& edges,
                                          const KeptFacets& kept, ArrangeReport& report,
                                          ProgressObserver* progress) {
  for (const bool releases_touching : {true, false}) {
    report.regions = 0;
    SheetRegions regions = merge_sheets(cut, points, sheets, edges, kept, releases_touching);
    std::optional<Surface> surface =
        SheetSurfaceMaker(cut, points, sheets, kept, std::move(regions), report, progress).run();
    if (surface || kept.singular_edges == 0) return surface;
  }
  return std::nullopt;
}

}  // namespace meshrepair::internal
