#include <cstddef>

#include <base/parallel.h>
#include <check/internal/triangle_list.h>
#include <check/internal/triangles_near.h>

namespace meshrepair::internal {
namespace {

// Enough that looking up takes longer than handing out the task.
constexpr std::size_t kBoxesPerTask = 16384;

}  // namespace

std::vector<std::uint32_t> triangles_near(const TriangleSoup& soup, std::span<const Box> boxes,
                                          double reach) {
  const BoxTree tree(boxes);
  const auto find = [&](std::size_t first, std::size_t last) {
    std::vector<std::uint32_t> near;
    for (std::size_t t = first; t < last; ++t) {
      const auto id = static_cast<std::uint32_t>(t);
      Box box = box_of(soup, id);
      box.widen(reach);
      if (meets_any(tree, boxes, box)) near.push_back(id);
    }
    return near;
  };
  return parallel_reduce(soup.triangles.size(), kBoxesPerTask, find,
                         [](std::vector<std::uint32_t>& all, std::vector<std::uint32_t> part) {
                           all.insert(all.end(), part.begin(), part.end());
                         });
}

}  // namespace meshrepair::internal
