// SPDX-License-Identifier: MIT
#include <check/internal/triangle_list.h>
#include <check/self_intersections.h>

#include "compare_triangles.h"
#include "nearby_part.h"
#include "tree_comparison.h"

namespace meshrepair {
namespace {

SelfIntersections with_those(const TriangleSoup& soup, std::span<const std::uint32_t> among,
                             const SelfIntersectionOptions& options) {
  const internal::SoupCorners corners(soup, options.weld);
  const internal::TriangleList list(corners, among);
  SelfIntersections result = internal::compare_with(corners, list, options);
  if (options.weld && list.size() > 0) {
    internal::add_crossing_sheets(corners, list.ids(), options, result);
  }
  return result;
}

}  // namespace

SelfIntersections self_intersections(const TriangleSoup& soup,
                                     const SelfIntersectionOptions& options) {
  const internal::SoupCorners corners(soup, options.weld);
  SelfIntersections result = internal::compare_all(corners, options);
  if (options.weld && result.count <= options.enough)
    internal::add_crossing_sheets(corners, {}, options, result);
  return result;
}

SelfIntersections self_intersections(const TriangleSoup& soup, std::span<const std::uint32_t> among,
                                     const SelfIntersectionOptions& options) {
  if (among.size() > soup.triangles.size() / internal::kFew) {
    return with_those(soup, among, options);
  }
  const internal::NearbyPart part =
      internal::nearby_part(soup, among, internal::kRoom * options.nearness);
  SelfIntersections result = with_those(part.soup, part.among, options);
  for (auto& pair : result.pairs) pair = {part.triangles[pair[0]], part.triangles[pair[1]]};
  return result;
}

}  // namespace meshrepair
