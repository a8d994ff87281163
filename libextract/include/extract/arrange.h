// SPDX-License-Identifier: MIT
// How triangles divide space, without cells: only the triangles are cut.
//
// Where all surfaces are closed, space need not be cut to find out what they enclose. Each triangle
// that meets others is cut in its own plane by these alone. Around the edges of its pieces the
// regions of space follow from piece to piece: these are the chambers, which have any shape, where
// the cells of a partition are convex. (EMBER, Trettner, Nehring-Wirxel and Kobbelt 2022, cuts
// faces alone, too, by a recursion over space; here all that meets a triangle comes at once.)
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <base/progress.h>
#include <bsp/clean_soup.h>
#include <extract/cut_nonmanifold.h>
#include <extract/extract_surface.h>
#include <extract/surface.h>
#include <mesh/edge_table.h>

namespace meshrepair {

struct ArrangeReport {
  std::size_t cut_triangles = 0;  // that meet others
  std::size_t facets = 0;         // of them
  std::size_t new_points = 0;
  std::size_t chambers = 0;
  std::size_t regions = 0;          // into which facets of the boundary were merged
  std::size_t singular_edges = 0;   // of the boundary, where solids touch
  std::size_t middle_vertices = 0;  // put into such edges, as MiddleVertices says
};

// A piece of a triangle between two chambers. The normal of the triangle's plane points from
// `below` to `above`.
struct ChamberWall {
  std::uint32_t below = 0, above = 0;
  std::uint32_t triangle = 0;  // of the soup; of several in one place the first
  double area = 0;             // in square grid steps, rounded
};

class Arrangement {
 public:
  // The soup has to outlive the result. Exact. An edge with one triangle alone has one chamber
  // around it. Nothing where more than 64 pairs of triangles meet for each triangle, or in rare
  // cases in which it cannot be told how parts lie in each other. n log n in what comes in and goes
  // out, but for triangles that very many others meet. Throws Cancelled.
  [[nodiscard]] static std::optional<Arrangement> make(const CleanSoup& soup, ArrangeReport& report,
                                                       ProgressObserver* progress = nullptr);
  Arrangement(Arrangement&&) noexcept;
  Arrangement& operator=(Arrangement&&) noexcept;
  ~Arrangement();

  [[nodiscard]] std::size_t chambers() const;
  static constexpr std::uint32_t kOutside = 0;  // the chamber that is not bounded
  // In cubic grid steps, rounded; of the outside without meaning.
  [[nodiscard]] std::vector<double> volumes() const;
  [[nodiscard]] std::vector<ChamberWall> walls() const;
  // The other triangles of walls that several are in: the number of the wall, and the triangle.
  struct Layer {
    std::uint32_t wall = 0;
    std::uint32_t triangle = 0;
  };
  [[nodiscard]] std::vector<Layer> layers() const;

  // What lies between regions, each a union of chambers: pieces of each place once, merged as those
  // of boundary() are, with the higher number behind. Points are there once; triangles meet in
  // corners and whole sides alone, until new points are rounded.
  struct Faces {
    Surface surface;  // no manifold where more than two regions meet
    std::vector<std::array<std::uint32_t, 2>> regions;  // of each triangle, in front and behind
  };
  // `region`: of each chamber. Nothing in rare cases in which pieces cannot be triangulated.
  [[nodiscard]] std::optional<Faces> faces(std::span<const std::uint32_t> region,
                                           ProgressObserver* progress = nullptr) const;

  // The surface between the chambers that are solid and the others. Triangles of which all is kept
  // have their corners, others are merged where they can be, new points are rounded from their
  // exact places. Nothing where the result would be no manifold.
  struct Boundary {
    Surface surface;
    // Of each triangle of the soup, where its pieces lie: bits, 1 on the boundary, 2 inside what is
    // solid, 4 outside; of several in one place only of the first.
    std::vector<std::uint8_t> places;
  };
  [[nodiscard]] std::optional<Boundary> boundary(const std::vector<char>& solid,
                                                 const ExtractOptions& options,
                                                 ArrangeReport& report) const;

 private:
  struct State;
  explicit Arrangement(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace meshrepair
