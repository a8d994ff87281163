// SPDX-License-Identifier: MIT
// The regions of a tree as it grows: on which sides of a plane are they?
#pragma once

#include <cstdint>
#include <vector>

#include <bsp/tree.h>
#include <exact/region_volume.h>
#include <extract/clip_cell.h>

namespace meshrepair::internal {

struct Sides {
  bool above = false, below = false;
};

// A region is the cell of a complex.
class CellRegions {
 public:
  using Region = CellId;

  explicit CellRegions(const CleanSoup& soup)
      : complex_(soup, outer_box(soup)), clipper_(complex_, engine_) {}

  [[nodiscard]] static Region all() { return CellId(0u); }

  [[nodiscard]] Sides sides(Region region, PlaneId plane) const {
    Sides sides;
    complex_.for_each_facet(region, [&](FacetId facet) {
      if (sides.above && sides.below) return;
      complex_.for_each_use(facet, [&](UseId use) {
        const VertexId vertex = complex_.origin(complex_.uses[use]);
        const int side = meshrepair::side(complex_.vertices[vertex], plane, complex_.planes);
        sides.above |= side > 0;
        sides.below |= side < 0;
      });
    });
    return sides;
  }

  // A plane that cuts it. Above, then below.
  std::array<Region, 2> cut(Region region, PlaneId plane) {
    const CellId below = clipper_.clip(region, plane);
    return {region, below};
  }

 private:
  ExactEngine engine_;
  CellComplex complex_;
  Clipper clipper_;
};

// A region is the way to it: a plane, the side, and the region that it was cut from.
class LinearRegions {
 public:
  using Region = std::uint32_t;

  explicit LinearRegions(const CleanSoup& soup) : planes_(soup.planes), volume_(outer_box(soup)) {}

  [[nodiscard]] static Region all() { return kAll; }

  [[nodiscard]] Sides sides(Region region, PlaneId plane) {
    walls_.clear();
    walls_.push_back(planes_[plane]);
    for (Region r = region; r != kAll; r = way_[r].from) {
      walls_.push_back(way_[r].below ? turned(planes_[way_[r].plane]) : planes_[way_[r].plane]);
    }
    Sides sides;
    sides.above = volume_.has_volume(walls_);
    walls_.front() = turned(walls_.front());
    // A region has volume: if it is not above, it is below.
    sides.below = !sides.above || volume_.has_volume(walls_);
    return sides;
  }

  std::array<Region, 2> cut(Region region, PlaneId plane) {
    const auto fresh = static_cast<Region>(way_.size());
    way_.push_back({plane, false, region});
    way_.push_back({plane, true, region});
    return {fresh, fresh + 1};
  }

 private:
  static constexpr Region kAll = ~Region{0};

  struct Step {
    PlaneId plane;
    bool below;
    Region from;
  };

  const PlaneTable& planes_;
  RegionVolume volume_;
  std::vector<Step> way_;
  std::vector<Plane> walls_;
};

}  // namespace meshrepair::internal
