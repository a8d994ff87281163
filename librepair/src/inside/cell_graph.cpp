// SPDX-License-Identifier: MIT
#include <algorithm>
#include <memory>
#include <utility>

#include <base/parallel.h>
#include <base/shared_progress.h>
#include <repair/cell_graph.h>

namespace meshrepair {
namespace {

// Areas are weights. One that rounding made 0 or worse would cut its cells off the system, so none
// is smaller than this; on a grid of 2^26 steps it is nothing beside any real facet. In square grid
// steps.
constexpr double kLeastArea = 1e-6;

// Some milliseconds of work.
constexpr std::size_t kFacetsPerTask = 8192;
constexpr std::size_t kCellsPerTask = 16384;

// Turns facets into links, in their order: tasks count theirs first, so that each knows where its
// own begin.
class LinkMaker {
 public:
  LinkMaker(const CellComplex& complex, const IdVector<FacetId, Cover>& cover,
            std::span<const CoverLayer> layers)
      : complex_(complex),
        cover_(cover),
        layers_(layers),
        tasks_(tasks_of(complex.facets.size(), kFacetsPerTask)) {}

  // The number of links; the cells beside facets of the outer box get a flag.
  std::size_t count(std::vector<char>& unbounded) {
    parallel_tasks(complex_.facets.size(), kFacetsPerTask,
                   [&](std::size_t task, std::size_t first, std::size_t last) {
                     for (FacetId f(first); f.index() < last; ++f.value) look_at(f, tasks_[task]);
                   });
    std::size_t count = 0;
    for (Task& task : tasks_) {
      for (const CellId c : std::exchange(task.unbounded, {})) unbounded[c.index()] = 1;
      task.first_link = std::exchange(count, count + task.links);
    }
    return count;
  }

  // After count(), into as many places.
  void make(std::vector<Link>& links, double* moments, ProgressObserver* progress) {
    CancelOnly quiet(progress);
    SharedProgress shared(&quiet, tasks_.size());
    parallel_tasks(
        complex_.facets.size(), kFacetsPerTask,
        [&](std::size_t task, std::size_t first, std::size_t last) {
          std::size_t next = tasks_[task].first_link;
          auto layer = layers_from(FacetId(first));
          for (FacetId f(first); f.index() < last; ++f.value) {
            while (layer != layers_.end() && layer->facet < f) ++layer;
            if (!is_link(complex_.facets[f])) continue;
            for (; layer != layers_.end() && layer->facet == f; ++layer) {
              tasks_[task].layers.push_back(
                  {static_cast<std::uint32_t>(next), layer->triangle, is_given(layer->triangle)});
            }
            const FacetMeasure measure = measure_facet(complex_, f);
            moments[next] = measure.moment;
            links[next++] = link_of(f, measure.area);
          }
          shared.done();
        });
  }

  // After make().
  [[nodiscard]] std::vector<CellGraph::Layer> layers() const {
    std::vector<CellGraph::Layer> all;
    for (const Task& task : tasks_) all.insert(all.end(), task.layers.begin(), task.layers.end());
    return all;
  }

 private:
  struct Task {
    std::size_t first_link = 0, links = 0;
    std::vector<CellId> unbounded;
    std::vector<CellGraph::Layer> layers;
  };

  void look_at(FacetId f, Task& task) const {
    const Facet& facet = complex_.facets[f];
    if (is_link(facet)) {
      ++task.links;
    } else {
      task.unbounded.push_back(facet.above.valid() ? facet.above : facet.below);
    }
  }

  [[nodiscard]] static bool is_link(const Facet& facet) {
    return facet.above.valid() && facet.below.valid();
  }

  [[nodiscard]] std::span<const CoverLayer>::iterator layers_from(FacetId first) const {
    return std::lower_bound(
        layers_.begin(), layers_.end(), first,
        [](const CoverLayer& layer, FacetId facet) { return layer.facet < facet; });
  }

  [[nodiscard]] bool is_given(TriangleId t) const {
    return complex_.soup().triangles[t].source != Triangle::kNoSource;
  }

  [[nodiscard]] Link link_of(FacetId f, double area) const {
    const Facet& facet = complex_.facets[f];
    // Triangles that close holes come after those of the input.
    const TriangleId first = cover_[f].triangle;
    const bool given = first.valid() && is_given(first);
    return {facet.below,
            facet.above,
            static_cast<float>(std::max(area, kLeastArea)),
            cover_[f].winding,
            first.valid() ? 1.0f : 0.0f,
            first,
            given};
  }

  const CellComplex& complex_;
  const IdVector<FacetId, Cover>& cover_;
  std::span<const CoverLayer> layers_;
  std::vector<Task> tasks_;
};

}  // namespace

CellGraph::CellGraph(const CellComplex& complex, const IdVector<FacetId, Cover>& cover,
                     ProgressObserver* progress, std::span<const CoverLayer> layers)
    : first_(complex.cells.size() + 1, 0),
      volume_(complex.cells.size()),
      unbounded_(complex.cells.size(), 0) {
  LinkMaker maker(complex, cover, layers);
  const std::size_t count = maker.count(unbounded_);
  links_.resize(count);
  const auto moments = std::make_unique_for_overwrite<double[]>(count);
  maker.make(links_, moments.get(), progress);
  layers_ = maker.layers();
  list_links_of_cells();
  // The links of a cell are in order, so that sums are rounded alike whatever the threads.
  parallel_tasks(cells(), kCellsPerTask, [&](std::size_t, std::size_t first, std::size_t last) {
    for (CellId c(first); c.index() < last; ++c.value) {
      double sum = 0;
      for (const std::uint32_t l : links_of(c)) {
        sum += links_[l].below == c ? moments[l] : -moments[l];
      }
      volume_[c.index()] = sum;
    }
  });
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

double lost_area(const CellGraph& graph, const std::vector<char>& solid) {
  double sum = 0;
  for (const Link& link : graph.links()) {
    const bool beside_solid = solid[link.below.index()] != 0 || solid[link.above.index()] != 0;
    if (link.given && !beside_solid) sum += link.area;
  }
  return sum;
}

CellGraph CellGraph::of_triangles(const IdVector<TriangleId, char>& wanted,
                                  const IdVector<TriangleId, std::int32_t>& winding) const {
  CellGraph some = *this;
  for (Link& link : some.links_) {
    if (!link.opaque() || wanted[link.triangle] != 0) continue;
    link.triangle = TriangleId();
    link.given = false;
  }
  some.layers_.clear();
  for (const Layer& layer : layers_) {
    if (wanted[layer.triangle] == 0) continue;
    Link& link = some.links_[layer.link];
    if (link.opaque()) {
      some.layers_.push_back(layer);
    } else {
      link.triangle = layer.triangle;
      link.given = layer.given;
    }
  }
  for (Link& link : some.links_) {
    if (!link.opaque()) link.opacity = 0;
  }
  some.set_windings(winding);
  return some;
}

}  // namespace meshrepair
