#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include <Eigen/Core>

#include <repair/thin_cells.h>

namespace meshrepair {
namespace {

// Of its normal and the direction across the cell, the least product of a side that is broad.
constexpr double kBroad = 0.5;

// Between two sheets a cell has more boundary than other sides. Under a single one it has about as
// much of both, and nothing would be gained.
constexpr double kMoreBoundary = 1.1;

// Of the volume: if more would go with what becomes empty, that is no fin but what there is.
constexpr double kMostFins = 0.1;

Vec3d vector_of(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }

class ThinCells {
 public:
  ThinCells(const CellComplex& complex, const IdVector<FacetId, Cover>& cover, double within,
            std::vector<char>& solid, std::span<const CellState> states)
      : complex_(complex),
        cover_(cover),
        within_(within),
        solid_(solid),
        states_(states),
        moved_(solid.size(), kUnchanged),
        waits_(solid.size(), 0),
        cut_(complex.soup().triangles.size(), 0) {}

  // Nothing changed if the report says so.
  ThinCellsReport run(ProgressObserver* progress) {
    CancelCheck cancel(progress);
    for (FacetId f(0u); f < complex_.facets.end_id(); ++f.value) {
      if (is_unknown(complex_.facets[f].above) || is_unknown(complex_.facets[f].below)) continue;
      if (!is_boundary(f)) {
        cut(f);
        continue;
      }
      enqueue(complex_.facets[f].above);
      enqueue(complex_.facets[f].below);
    }
    for (std::size_t next = 0; next < queue_.size(); ++next) {
      cancel.tick();
      waits_[queue_[next].index()] = 0;
      consider(queue_[next]);
    }
    return emptied_volume_ <= kMostFins * known_volume() ? report_ : ThinCellsReport{};
  }

 private:
  static constexpr double kUnchanged = -1;

  // A facet of the cell that is looked at.
  struct Side {
    FacetId facet;
    CellId other;  // invalid: outside the box
    Vec3d outward;
    double area;
    bool is_boundary;
  };

  struct Width {
    double width;
    Vec3d across;
  };

  [[nodiscard]] bool is_solid(CellId cell) const {
    return cell.valid() && solid_[cell.index()] != 0;
  }

  [[nodiscard]] bool is_boundary(FacetId f) const {
    const Facet& facet = complex_.facets[f];
    return !is_unknown(facet.above) && !is_unknown(facet.below) &&
           is_solid(facet.above) != is_solid(facet.below);
  }

  void cut(FacetId f) {
    if (cover_[f].opaque()) cut_[cover_[f].triangle.index()] = 1;
  }

  [[nodiscard]] bool is_cut(FacetId f) const {
    return !cover_[f].opaque() || cut_[cover_[f].triangle.index()] != 0;
  }

  [[nodiscard]] CellState state_of(CellId cell) const {
    return cell.valid() && !states_.empty() ? states_[cell.index()] : CellState::free;
  }
  [[nodiscard]] bool is_unknown(CellId cell) const { return state_of(cell) == CellState::unknown; }

  // Of what was solid at first; looked at only where something became empty.
  [[nodiscard]] double known_volume() const {
    double volume = emptied_volume_;
    if (emptied_volume_ == 0) return volume;
    for (CellId c(0u); c < complex_.cells.end_id(); ++c.value) {
      const bool was_solid = is_solid(c) && moved_[c.index()] == kUnchanged;
      if (was_solid && !is_unknown(c)) volume += cell_volume(complex_, c);
    }
    return volume;
  }

  void enqueue(CellId cell) {
    if (!cell.valid() || waits_[cell.index()] != 0 || moved_[cell.index()] != kUnchanged) return;
    waits_[cell.index()] = 1;
    queue_.push_back(cell);
  }

  void consider(CellId cell) {
    find_sides(cell);
    double boundary = 0, other = 0;
    bool is_any_cut = false;
    for (const Side& side : sides_) {
      (side.is_boundary ? boundary : other) += side.area;
      is_any_cut = is_any_cut || (side.is_boundary && is_cut(side.facet));
    }
    if (!is_any_cut || !(boundary > kMoreBoundary * other)) return;
    const std::optional<Width> width = find_width();
    if (!width) return;
    const double moved = distance_to_boundary(*width);
    if (!(moved <= within_)) return;
    if (state_of(cell) == CellState::free) {
      change(cell, moved, boundary - other);
    } else {
      report_.reaches_fixed = true;
    }
  }

  void find_sides(CellId cell) {
    sides_.clear();
    complex_.for_each_facet(cell, [&](FacetId f) {
      const Facet& facet = complex_.facets[f];
      const bool is_below = facet.below == cell;
      const Vec3d normal = vector_of(complex_.planes[facet.plane].unit);
      sides_.push_back({f, is_below ? facet.above : facet.below, is_below ? normal : Vec3d(-normal),
                        facet_area(complex_, f), is_boundary(f)});
    });
  }

  // The least distance of a facet's plane from the vertex farthest from it, if it is no more than
  // the bound. A convex cell may be thinner between two edges, but not by much.
  [[nodiscard]] std::optional<Width> find_width() const {
    std::optional<Width> best;
    for (const Side& side : sides_) {
      const double width = width_from(side, best ? best->width : within_);
      if (!(width <= within_) || (best && width >= best->width)) continue;
      best = {width, side.outward};
    }
    return best;
  }

  // Gives up beyond `most`.
  [[nodiscard]] double width_from(const Side& from, double most) const {
    const Use& first = complex_.uses[complex_.facets[from.facet].first_use];
    const Vec3d on_plane = vector_of(complex_.vertices[complex_.origin(first)].position);
    double width = 0;
    for (const Side& side : sides_) {
      if (width > most) break;
      complex_.for_each_use(side.facet, [&](UseId use) {
        const Point& p = complex_.vertices[complex_.origin(complex_.uses[use])];
        const double distance = std::abs((vector_of(p.position) - on_plane).dot(from.outward));
        width = std::max(width, distance + static_cast<double>(p.error));
      });
    }
    return width;
  }

  // Of any point of the cell, from where the boundary was at first, along the direction across: one
  // broad side is all boundary, and may have been moved by itself. Infinite if neither is.
  [[nodiscard]] double distance_to_boundary(const Width& width) const {
    double best = std::numeric_limits<double>::infinity();
    for (const double sign : {1.0, -1.0}) {
      double moved = 0;
      bool is_any = false, is_all_boundary = true;
      for (const Side& side : sides_) {
        if (sign * side.outward.dot(width.across) < kBroad) continue;
        is_any = true;
        is_all_boundary = is_all_boundary && side.is_boundary;
        if (side.other.valid()) moved = std::max(moved, moved_[side.other.index()]);
      }
      if (is_any && is_all_boundary) best = std::min(best, moved + width.width);
    }
    return best;
  }

  void change(CellId cell, double moved, double area) {
    moved_[cell.index()] = moved;
    char& solid = solid_[cell.index()];
    if (solid == 0) {
      ++report_.filled;
      report_.filled_area += area;
    } else {
      ++report_.emptied;
      report_.emptied_area += area;
      emptied_volume_ += cell_volume(complex_, cell);
    }
    solid = solid == 0 ? 1 : 0;
    for (const Side& side : sides_) {
      if (side.is_boundary) cut(side.facet);
      enqueue(side.other);
    }
  }

  const CellComplex& complex_;
  const IdVector<FacetId, Cover>& cover_;
  double within_;
  std::vector<char>& solid_;
  std::span<const CellState> states_;
  std::vector<double> moved_;  // of each cell that changed, how far that moved the boundary
  std::vector<char> waits_;
  std::vector<char> cut_;  // of each triangle, whether a piece of it is no boundary
  std::vector<CellId> queue_;
  std::vector<Side> sides_;
  double emptied_volume_ = 0;
  ThinCellsReport report_;
};

}  // namespace

ThinCellsReport relabel_thin_cells(const CellComplex& complex,
                                   const IdVector<FacetId, Cover>& cover, double within,
                                   std::vector<char>& solid, ProgressObserver* progress,
                                   std::span<const CellState> states) {
  std::vector<char> changed = solid;
  const ThinCellsReport report = ThinCells(complex, cover, within, changed, states).run(progress);
  if (report.filled + report.emptied > 0) solid = std::move(changed);
  return report;
}

}  // namespace meshrepair
