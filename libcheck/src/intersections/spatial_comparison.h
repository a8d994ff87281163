// SPDX-License-Identifier: MIT
// Which triangles meet, where their boxes tell them apart badly?
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <base/progress.h>
#include <check/box_tree.h>
#include <check/internal/triangle_list.h>
#include <check/internal/triangle_pair.h>

namespace meshrepair::internal {

// Two triangles by their places in a list, the lower one first.
struct MeetingPair {
  std::uint32_t a = 0, b = 0;
  Meeting meeting = Meeting::apart;
};

// Would a comparison of boxes look at very many pairs of triangles that do not meet? Told by a
// sample. Pairs with the same hub (triangle_hubs.h; empty: none) do not count; `tree` is that of
// the boxes.
[[nodiscard]] bool boxes_tell_little(const TriangleList& triangles,
                                     std::span<const std::uint32_t> hubs, const BoxTree& tree);

// All pairs that meet, but for those with the same hub; sorted. n log n where triangles are near to
// few others, however long they are; empty where that is not so, and comparing boxes may be as
// fast. `progress` is asked whether to go on; it may be null.
[[nodiscard]] std::optional<std::vector<MeetingPair>> compare_in_space(
    const TriangleList& triangles, std::span<const std::uint32_t> hubs, ProgressObserver* progress);

}  // namespace meshrepair::internal
