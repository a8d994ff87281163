// Where a soup is not the surface of a solid as it is: the tangles of triangles that meet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <base/progress.h>
#include <bsp/clean_soup.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

struct Tangles {
  TriangleSoup on_grid;               // the soup's triangles and points, in grid units
  std::vector<std::int32_t> winding;  // of each triangle, turned as its corners are
  // Of each triangle: it meets another one in more than corners and edges that they share, or is at
  // an edge that does not have just two triangles, turned alike, each once.
  std::vector<char> tangled;
  std::size_t count = 0;  // of these
  // Of each triangle that is not, the patch: what is connected through edges of such triangles
  // alone. kNone for the others.
  std::vector<std::uint32_t> patch_of;
  std::uint32_t patches = 0;
};

// Nothing if the windings, given against the normals of the triangles' planes, do not balance at
// every edge, so that no place has a winding number, or if more pairs of triangles meet than there
// are triangles. `progress` is asked whether to go on. Exact. n log n.
[[nodiscard]] std::optional<Tangles> find_tangles(const CleanSoup& soup,
                                                  const IdVector<TriangleId, std::int32_t>& winding,
                                                  ProgressObserver* progress);

// Takes some more for tangled.
void add_tangled(std::span<const std::uint32_t> triangles, Tangles& tangles);

}  // namespace meshrepair::internal
