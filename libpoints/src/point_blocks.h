// SPDX-License-Identifier: MIT
// Work on the points of a cloud, block by block in parallel.
#pragma once

#include <cstddef>

#include <base/parallel.h>
#include <base/progress.h>
#include <base/shared_progress.h>

namespace meshrepair {

// Large enough to spread the costs of a task, small enough to be stopped between two.
constexpr std::size_t kPointsInBlock = 512;

[[nodiscard]] inline std::size_t blocks_of(std::size_t points) {
  return tasks_of(points, kPointsInBlock);
}

// Calls work(block, first, last) for each block. What it does must not depend on which thread it
// runs in, so that results do not depend on their number. Throws Cancelled.
template <class Work>
void for_blocks(std::size_t points, ProgressObserver* progress, const Work& work) {
  SharedProgress shared(progress, blocks_of(points));
  const auto do_block = [&](std::size_t block, std::size_t first, std::size_t last) {
    work(block, first, last);
    shared.done();
  };
  parallel_tasks(points, kPointsInBlock, do_block);
}

}  // namespace meshrepair
