// SPDX-License-Identifier: MIT
// How the clipper asks about geometry: the only door through which numbers reach the topology.
#pragma once

#include <string_view>

#include <exact/plane_table.h>
#include <exact/point.h>
#include <exact/predicates.h>

namespace meshrepair {

// Who says on which side of a plane a point of the cells lies. The rest is exact in either case:
// the working grid, the tree, the certificate.
enum class Predicates { exact, floating };

[[nodiscard]] std::string_view predicates_name(Predicates predicates);

// An engine may be wrong about sides: the clipper keeps the topology valid whatever it says.
class PredicateEngine {
 public:
  PredicateEngine() = default;
  PredicateEngine(const PredicateEngine&) = delete;
  PredicateEngine& operator=(const PredicateEngine&) = delete;
  virtual ~PredicateEngine() = default;

  // Whether it is never wrong: then a plane that does not cut a cell is not a cut of a valid tree.
  [[nodiscard]] virtual bool exact() const { return false; }
  // Of the loose points that are made of what it says, in grid steps.
  [[nodiscard]] virtual double tolerance() const { return 0; }
  // -1 below, 0 on, +1 above the plane.
  virtual int side(const Point& point, PlaneId plane, const PlaneTable& planes) = 0;
  // The point where the edge from `a` to `b`, on the common line of planes p and q, passes through
  // `plane`.
  virtual Point cross(const Point& a, const Point& b, PlaneId p, PlaneId q, PlaneId plane,
                      const PlaneTable& planes) = 0;
};

// Never wrong.
class ExactEngine final : public PredicateEngine {
 public:
  [[nodiscard]] bool exact() const override { return true; }
  int side(const Point& point, PlaneId plane, const PlaneTable& planes) override {
    return meshrepair::side(point, plane, planes);
  }
  Point cross(const Point& a, const Point& b, PlaneId p, PlaneId q, PlaneId plane,
              const PlaneTable& planes) override {
    const auto& u = a.position;
    const auto& v = b.position;
    return meet(planes, p, q, plane,
                {0.5 * (u[0] + v[0]), 0.5 * (u[1] + v[1]), 0.5 * (u[2] + v[2])});
  }
};

}  // namespace meshrepair
