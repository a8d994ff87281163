#include <algorithm>
#include <vector>

#include <bsp/disjoint_sets.h>
#include <bsp/topology.h>
#include <repair/drop_small_parts.h>

namespace meshrepair {
namespace {

// The part of each triangle, named by its lowest point, and the triangles of each part.
struct Parts {
  std::vector<std::uint32_t> of_triangle;
  std::vector<std::size_t> size;

  explicit Parts(const TriangleSoup& mesh) : size(mesh.points.size(), 0) {
    DisjointSets sets(mesh.points.size());
    for (const auto& t : mesh.triangles) {
      sets.join(t[0], t[1]);
      sets.join(t[0], t[2]);
    }
    for (const auto& t : mesh.triangles) {
      of_triangle.push_back(sets.root(t[0]));
      ++size[of_triangle.back()];
    }
  }

  [[nodiscard]] std::size_t smaller_than(std::size_t fewest) const {
    return static_cast<std::size_t>(std::count_if(
        size.begin(), size.end(), [&](std::size_t n) { return n > 0 && n < fewest; }));
  }
  [[nodiscard]] std::size_t largest() const {
    return size.empty() ? 0 : *std::max_element(size.begin(), size.end());
  }
};

// Points that nothing uses any more go, too.
Surface only_large(const Surface& surface, const Parts& parts, std::size_t fewest) {
  constexpr auto kUnused = static_cast<std::uint32_t>(-1);
  std::vector<std::uint32_t> number(surface.mesh.points.size(), kUnused);
  Surface kept;
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    if (parts.size[parts.of_triangle[t]] < fewest) continue;
    auto corners = surface.mesh.triangles[t];
    for (std::uint32_t& p : corners) {
      if (number[p] == kUnused) {
        number[p] = static_cast<std::uint32_t>(kept.mesh.points.size());
        kept.mesh.points.push_back(surface.mesh.points[p]);
        kept.input_point.push_back(surface.input_point[p]);
      }
      p = number[p];
    }
    kept.mesh.triangles.push_back(corners);
    kept.source.push_back(surface.source[t]);
  }
  return kept;
}

}  // namespace

std::size_t drop_small_parts(Surface& surface, std::size_t fewest, RepairReport& report) {
  const Parts parts(surface.mesh);
  const std::size_t small = parts.smaller_than(fewest);
  if (small == 0 || parts.largest() < fewest) return 0;
  surface = only_large(surface, parts, fewest);
  report.output = examine_topology(surface.mesh.triangles, surface.mesh.points.size());
  report.output_volume = signed_volume(surface.mesh);
  report.output_area = surface_area(surface.mesh);
  return small;
}

}  // namespace meshrepair
