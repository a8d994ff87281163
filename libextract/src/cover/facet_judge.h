// SPDX-License-Identifier: MIT
// What the triangles of a facet cover of it, and where to cut it if that is a part. Changes
// nothing, so that many facets can be judged at once.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <extract/cell_complex.h>

namespace meshrepair::internal {

struct PreparedTriangle {
  std::array<Point, 3> corners;
  std::array<Plane, 3>
      edges;  // across the triangle's plane; the triangle is on the positive side of each
};

[[nodiscard]] PreparedTriangle prepare_triangle(const CleanSoup& soup, TriangleId id);

enum class Coverage { none, part, full };

// How much of the facet, which lies in the triangle's plane, the triangle covers. Touching is none.
// Bit k of `inside` says that the facet is known to be on the inner side of edge k.
[[nodiscard]] Coverage coverage_of(const CellComplex& complex, FacetId facet,
                                   const PreparedTriangle& triangle, std::uint32_t inside = 0);

// Whether the triangle covers the facet's centre, by rounded numbers: a guess.
[[nodiscard]] bool covers_centre(const CellComplex& complex, FacetId facet,
                                 const PreparedTriangle& triangle);

// Whether the facet has vertices strictly on both sides.
[[nodiscard]] bool crosses(const CellComplex& complex, FacetId facet, const Plane& plane);

// A triangle that may cover a part of a facet.
struct Undecided {
  TriangleId triangle;
  std::uint32_t inside = 0;  // bit k: the facet was cut off along edge k, and is inside of it
};

// Along an edge of a triangle.
struct FacetCut {
  Plane plane;
  TriangleId triangle;
  std::size_t edge = 0;
};

class FacetJudge {
 public:
  explicit FacetJudge(const CellComplex& complex) : complex_(complex) {}

  // Puts those of the undecided triangles that cover all of the facet into `covering`, and drops
  // those that miss it; the rest, if any, cover a part. Then returns where to cut the facet; in a
  // loose complex perhaps nothing. If many are undecided, the facet is to be cut first: most of
  // them will be elsewhere.
  std::optional<FacetCut> judge(FacetId facet, std::vector<Undecided>& undecided,
                                std::vector<TriangleId>& covering);

  // Whether the triangle covers the facet's centre, by rounded numbers.
  [[nodiscard]] bool covers_centre(FacetId facet, TriangleId t) {
    return internal::covers_centre(complex_, facet, prepared(t));
  }

  struct Reach {
    bool positive = false, negative = false;
  };
  // On which sides of the plane the triangle has corners.
  [[nodiscard]] Reach reach_of(TriangleId t, const Plane& plane) const;

 private:
  void decide(FacetId facet, std::vector<Undecided>& undecided, std::vector<TriangleId>& covering);
  std::optional<FacetCut> choose_cut(FacetId facet, const std::vector<Undecided>& list);
  [[nodiscard]] std::size_t cost_of(const Plane& edge, const std::vector<Undecided>& list) const;

  // Facets of one node follow each other and mostly ask for the same triangle.
  const PreparedTriangle& prepared(TriangleId t) {
    if (t != prepared_id_) {
      prepared_ = prepare_triangle(complex_.soup(), t);
      prepared_id_ = t;
    }
    return prepared_;
  }

  const CellComplex& complex_;
  PreparedTriangle prepared_;
  TriangleId prepared_id_;
};

}  // namespace meshrepair::internal
