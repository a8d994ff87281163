// SPDX-License-Identifier: MIT
// The cells and the links between them: all that the inside rules look at.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <base/progress.h>
#include <extract/cell_complex.h>
#include <extract/cover_facets.h>

namespace meshrepair {

// A facet between two cells.
struct Link {
  CellId below, above;
  float area = 0;            // grid units, from rounded coordinates: a weight
  std::int32_t winding = 0;  // of the cover, against the direction from below to above
  float opacity = 0;         // 0 where no triangle covers it, up to 1
  TriangleId triangle;       // the lowest id of those that cover it; invalid: none
  bool given = false;        // one of these is of the input, and not there to close a hole

  [[nodiscard]] bool opaque() const { return triangle.valid(); }
};

class CellGraph {
 public:
  // `layers` as cover_facets() gives them; without them set_windings() takes every facet to be
  // covered by one triangle alone. `progress` is asked whether to go on.
  CellGraph(const CellComplex& complex, const IdVector<FacetId, Cover>& cover,
            ProgressObserver* progress = nullptr, std::span<const CoverLayer> layers = {});

  // Of any regions, with the links between them; those that are not bounded have a flag. A layer is
  // one more triangle on a link.
  struct Layer {
    std::uint32_t link;
    TriangleId triangle;
    bool given;  // it is of the input
  };
  CellGraph(std::vector<Link> links, std::vector<Layer> layers, std::vector<double> volumes,
            std::vector<char> unbounded);

  // Sets the windings of the links to those of triangles that are turned otherwise, against the
  // normals of their planes.
  void set_windings(const IdVector<TriangleId, std::int32_t>& winding);

  // Sets the opacities of covered links, 1 until then, to those of triangles, of several the most.
  void set_opacities(const IdVector<TriangleId, float>& opacity);

  // The same regions between some of the triangles alone, which have a flag; links keep their
  // opacities.
  [[nodiscard]] CellGraph of_triangles(const IdVector<TriangleId, char>& wanted,
                                       const IdVector<TriangleId, std::int32_t>& winding) const;

  [[nodiscard]] std::size_t cells() const { return first_.size() - 1; }
  [[nodiscard]] const std::vector<Link>& links() const { return links_; }
  // Positions in links() of the links of a cell.
  [[nodiscard]] std::span<const std::uint32_t> links_of(CellId cell) const {
    const std::uint32_t first = first_[cell.index()];
    return {of_cell_.data() + first, first_[cell.index() + 1] - first};
  }
  // In cubic grid steps, rounded; of an unbounded cell without meaning.
  [[nodiscard]] double volume(CellId cell) const { return volume_[cell.index()]; }
  // Whether a facet of the cell lies on the outer box: such cells are empty by definition.
  [[nodiscard]] bool unbounded(CellId cell) const { return unbounded_[cell.index()] != 0; }

 private:
  void list_links_of_cells();

  std::vector<Link> links_;
  std::vector<Layer> layers_;
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> of_cell_;
  std::vector<double> volume_;
  std::vector<char> unbounded_;
};

// Of links that triangles of the input cover, with nothing solid on either side. In square grid
// steps.
[[nodiscard]] double lost_area(const CellGraph& graph, const std::vector<char>& solid);

[[nodiscard]] inline CellId other_end(const Link& link, CellId cell) {
  return link.below == cell ? link.above : link.below;
}

}  // namespace meshrepair
