// Work on the points of a cloud, block by block in parallel.
#pragma once

#include <algorithm>
#include <cstddef>

#include <tbb/parallel_for.h>

#include <base/progress.h>
#include <base/shared_progress.h>

namespace meshrepair {

// Large enough to spread the costs of a task, small enough to be stopped between two.
constexpr std::size_t kPointsInBlock = 512;

[[nodiscard]] inline std::size_t blocks_of(std::size_t points) {
  return (points + kPointsInBlock - 1) / kPointsInBlock;
}

// Calls work(block, first, last) for each block. What it does must not depend on which thread it
// runs in, so that results do not depend on their number. Throws Cancelled.
template <class Work>
void for_blocks(std::size_t points, ProgressObserver* progress, const Work& work) {
  SharedProgress shared(progress, blocks_of(points));
  tbb::parallel_for(std::size_t{0}, blocks_of(points), [&](std::size_t block) {
    const std::size_t first = block * kPointsInBlock;
    work(block, first, std::min(first + kPointsInBlock, points));
    shared.done();
  });
}

}  // namespace meshrepair
