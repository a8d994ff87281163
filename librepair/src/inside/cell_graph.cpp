#include <algorithm>
#include <utility>

#include <repair/cell_graph.h>

namespace meshrepair {
namespace {

// Areas are weights. One that rounding made 0 or worse would cut its cells off the system, so none
// is smaller than this; on a grid of 2^26 steps it is nothing beside any real facet. In square grid
// steps.
constexpr double kLeastArea = 1e-6;

}  // namespace

CellGraph::CellGraph(const CellComplex& complex, const IdVector<FacetId, Cover>& cover,
                     ProgressObserver* progress, std::span<const CoverLayer> layers,
                     std::span<const char> left_out)
    : first_(complex.cells.size() + 1, 0),
      volume_(complex.cells.size(), 0),
      unbounded_(complex.cells.size(), 0) {
  CancelCheck check(progress);
  const auto is_given = [&](TriangleId t) {
    return complex.soup().triangles[t].source != Triangle::kNoSource;
  };
  const auto is_left_out = [&](CellId c) { return !left_out.empty() && left_out[c.index()] != 0; };
  std::size_t next_layer = 0;
  for (FacetId f(0u); f < complex.facets.end_id(); ++f.value) {
    check.tick();
    const Facet& facet = complex.facets[f];
    if (!facet.above.valid()) {
      unbounded_[facet.below.index()] = 1;
    } else if (!facet.below.valid()) {
      unbounded_[facet.above.index()] = 1;
    } else if (!is_left_out(facet.below) && !is_left_out(facet.above)) {
      while (next_layer < layers.size() && layers[next_layer].facet < f) ++next_layer;
      for (; next_layer < layers.size() && layers[next_layer].facet == f; ++next_layer) {
        layers_.push_back({static_cast<std::uint32_t>(links_.size()), layers[next_layer].triangle});
      }
      const FacetMeasure measure = measure_facet(complex, f);
      volume_[facet.below.index()] += measure.moment;
      volume_[facet.above.index()] -= measure.moment;
      // Triangles that close holes come after those of the input.
      const TriangleId first = cover[f].triangle;
      links_.push_back({facet.below, facet.above,
                        static_cast<float>(std::max(measure.area, kLeastArea)), cover[f].winding,
                        first.valid() ? 1.0f : 0.0f, first, first.valid() && is_given(first)});
    }
  }
  list_links_of_cells();
}

CellGraph::CellGraph(std::vector<Link> links, std::vector<Layer> layers,
                     std::vector<double> volumes, std::vector<char> unbounded)
    : links_(std::move(links)),
      layers_(std::move(layers)),
      first_(volumes.size() + 1, 0),
      volume_(std::move(volumes)),
      unbounded_(std::move(unbounded)) {
  list_links_of_cells();
}

void CellGraph::list_links_of_cells() {
  for (const Link& link : links_) {
    ++first_[link.below.index() + 1];
    ++first_[link.above.index() + 1];
  }
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  of_cell_.resize(2 * links_.size());
  std::vector<std::uint32_t> filled(first_.begin(), first_.end() - 1);
  for (std::uint32_t l = 0; l < links_.size(); ++l) {
    of_cell_[filled[links_[l].below.index()]++] = l;
    of_cell_[filled[links_[l].above.index()]++] = l;
  }
}

void CellGraph::set_opacities(const IdVector<TriangleId, float>& opacity) {
  for (Link& link : links_) {
    if (link.opaque()) link.opacity = opacity[link.triangle];
  }
  for (const Layer& layer : layers_) {
    float& most = links_[layer.link].opacity;
    most = std::max(most, opacity[layer.triangle]);
  }
}

void CellGraph::set_windings(const IdVector<TriangleId, std::int32_t>& winding) {
  for (Link& link : links_) link.winding = link.opaque() ? winding[link.triangle] : 0;
  for (const Layer& layer : layers_) links_[layer.link].winding += winding[layer.triangle];
}

}  // namespace meshrepair
