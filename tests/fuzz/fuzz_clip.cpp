// SPDX-License-Identifier: MIT
// The clipper: a box, planes of the input's choice, cells of its choice. The first byte says who
// answers the clipper's questions: exact predicates, which are asked for cuts that are some, exact
// ones for planes that may miss the cell, the input, whose answers contradict each other, or
// floating predicates with a tolerance of the input's choice. The topology has to hold in each
// case, the geometry in the first.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include <extract/clip_cell.h>
#include <extract/float_engine.h>

#include "cells/check_complex.h"
#include "fuzz_input.h"

namespace meshrepair::testing {
namespace {

constexpr std::size_t kMostClips = 24;
// Of the box's sides, in steps of the coordinates below.
constexpr std::size_t kSteps = 16;
constexpr std::int32_t kStep = kGridRadius / kSteps;

enum class Answers { exact, exact_for_any_plane, from_input, floating };
constexpr std::size_t kAnswers = 4;

// Whatever the input says, as long as it lasts.
class LyingEngine final : public PredicateEngine {
 public:
  explicit LyingEngine(FuzzInput& input) : input_(input) {}

  int side(const Point& point, PlaneId plane, const PlaneTable& planes) override {
    const std::uint8_t answer = input_.byte() % 4;
    return answer == 0 ? exact_.side(point, plane, planes) : answer - 2;
  }
  Point cross(const Point& a, const Point& b, PlaneId p, PlaneId q, PlaneId plane,
              const PlaneTable& planes) override {
    return exact_.cross(a, b, p, q, plane, planes);
  }

 private:
  FuzzInput& input_;
  ExactEngine exact_;
};

class ClipRun {
 public:
  explicit ClipRun(FuzzInput& input)
      : input_(input),
        answers_(static_cast<Answers>(input.below(kAnswers))),
        box_(choose_box()),
        complex_(soup_, box_),
        clipper_(complex_, engine()) {}

  void run() {
    for (std::size_t clips = 0; clips < kMostClips && !input_.empty(); ++clips) {
      const CellId cell(input_.below(complex_.cells.size()));
      const PlaneId plane = choose_plane();
      if (answers_ == Answers::exact && !cuts(cell, plane)) continue;
      const CellId below = clipper_.clip(cell, plane);
      internal::check_cell(complex_, cell);
      internal::check_cell(complex_, below);
    }
    internal::check_complex(complex_);
    if (answers_ == Answers::exact) check_geometry();
  }

 private:
  GridBox choose_box() {
    GridBox box;
    for (std::int32_t GridPoint::*axis : {&GridPoint::x, &GridPoint::y, &GridPoint::z}) {
      box.low.*axis = -kStep * static_cast<std::int32_t>(1 + input_.below(kSteps));
      box.high.*axis = kStep * static_cast<std::int32_t>(1 + input_.below(kSteps));
    }
    return box;
  }

  PredicateEngine& engine() {
    if (answers_ == Answers::from_input) return lying_;
    if (answers_ == Answers::floating) {
      // From far below rounding to a quarter of the grid.
      const int exponent = kGridBits - 2 - static_cast<int>(input_.below(60));
      return floating_.emplace(std::ldexp(1.0, exponent));
    }
    return exact_;
  }

  std::int32_t coarse_coordinate() {
    return kStep * (static_cast<std::int32_t>(input_.below(2 * kSteps + 1)) -
                    static_cast<std::int32_t>(kSteps));
  }
  GridPoint coarse_point() {
    const std::int32_t x = coarse_coordinate();
    const std::int32_t y = coarse_coordinate();
    return {x, y, coarse_coordinate()};
  }
  // Anywhere on the grid.
  GridPoint fine_point() {
    const auto coordinate = [&] {
      return static_cast<std::int32_t>(input_.number<std::uint32_t>() %
                                       (2 * std::uint32_t{kGridRadius} + 1)) -
             kGridRadius;
    };
    const std::int32_t x = coordinate();
    const std::int32_t y = coordinate();
    return {x, y, coordinate()};
  }
  // A point of before, moved by at most one step of the grid along each axis.
  GridPoint near_point() {
    if (points_.empty()) return coarse_point();
    GridPoint p = points_[input_.below(points_.size())];
    for (std::int32_t GridPoint::*axis : {&GridPoint::x, &GridPoint::y, &GridPoint::z}) {
      const auto moved = p.*axis + static_cast<std::int32_t>(input_.below(3)) - 1;
      p.*axis = std::clamp(moved, -kGridRadius, kGridRadius);
    }
    return p;
  }
  GridPoint choose_point() {
    switch (input_.below(4)) {
      case 0:
        points_.push_back(fine_point());
        break;
      case 1:
        points_.push_back(near_point());
        break;
      default:
        points_.push_back(coarse_point());
    }
    return points_.back();
  }

  PlaneId choose_plane() {
    const std::size_t kind = input_.below(4);
    if (kind == 0 && !planes_.empty()) return planes_[input_.below(planes_.size())];
    const GridPoint a = choose_point();
    Plane plane;
    if (kind == 1) {
      plane = plane_along_axis(a, choose_point(), static_cast<int>(input_.below(3)));
    } else {
      const GridPoint b = choose_point();
      plane = plane_through(a, b, choose_point());
    }
    if (is_null(plane)) plane = make_plane({0, 1, 0}, -Int128{a.y});
    planes_.push_back(complex_.planes.append(plane));
    return planes_.back();
  }

  [[nodiscard]] std::set<VertexId> vertices_of(CellId cell) const {
    std::set<VertexId> vertices;
    complex_.for_each_facet(cell, [&](FacetId f) {
      complex_.for_each_use(f,
                            [&](UseId u) { vertices.insert(complex_.origin(complex_.uses[u])); });
    });
    return vertices;
  }

  [[nodiscard]] bool cuts(CellId cell, PlaneId plane) const {
    bool above = false;
    bool below = false;
    for (const VertexId v : vertices_of(cell)) {
      const int s = side(complex_.vertices[v], plane, complex_.planes);
      above |= s > 0;
      below |= s < 0;
    }
    return above && below;
  }

  void check_geometry() const {
    require(clipper_.report().fallbacks() == 0, "a step went beyond the plain case");
    for (CellId c(0u); c < complex_.cells.end_id(); ++c.value) check_convex(c);
    check_volumes();
  }

  // The cell is what the planes of its facets cut out.
  void check_convex(CellId cell) const {
    const std::set<VertexId> vertices = vertices_of(cell);
    complex_.for_each_facet(cell, [&](FacetId f) {
      const Facet& facet = complex_.facets[f];
      const int inside = facet.above == cell ? 1 : -1;
      std::size_t off_plane = 0;
      for (const VertexId v : vertices) {
        const int s = side(complex_.vertices[v], facet.plane, complex_.planes);
        require(s * inside >= 0, "a cell is not convex");
        if (s != 0) ++off_plane;
      }
      require(off_plane > 0, "a cell is flat");
      complex_.for_each_use(f, [&](UseId u) {
        const VertexId v = complex_.origin(complex_.uses[u]);
        require(side(complex_.vertices[v], facet.plane, complex_.planes) == 0,
                "a vertex is not in the plane of its facet");
      });
    });
  }

  // The parts make the whole, but for the rounding of positions.
  void check_volumes() const {
    double error = 0;
    for (const Point& v : complex_.vertices) error = std::max(error, double{v.error});
    double sum = 0;
    double area = 0;
    for (CellId c(0u); c < complex_.cells.end_id(); ++c.value) {
      sum += cell_volume(complex_, c);
      complex_.for_each_facet(c, [&](FacetId f) { area += facet_area(complex_, f); });
    }
    const CellComplex whole(soup_, box_);
    const double expected = cell_volume(whole, CellId(0u));
    constexpr double kRounding = 1e-9;  // of sums of products of coordinates
    require(std::abs(sum - expected) <= kRounding * expected + 4 * error * area,
            "the volumes of the cells do not add up to that of the box");
  }

  FuzzInput& input_;
  Answers answers_;
  CleanSoup soup_;
  GridBox box_;
  CellComplex complex_;
  ExactEngine exact_;
  std::optional<FloatEngine> floating_;
  LyingEngine lying_{input_};  // they stand before the clipper, which holds on to one of them
  Clipper clipper_;
  std::vector<GridPoint> points_;
  std::vector<PlaneId> planes_;
};

}  // namespace
}  // namespace meshrepair::testing

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  meshrepair::testing::FuzzInput input(data, size);
  meshrepair::testing::ClipRun(input).run();
  return 0;
}
