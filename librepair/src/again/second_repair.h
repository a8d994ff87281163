// SPDX-License-Identifier: MIT
// A repair of what another one made, with triangles that were added to it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <extract/surface.h>
#include <mesh/soup.h>
#include <repair/repair_options.h>
#include <repair/repair_report.h>

namespace meshrepair::internal {

// What is repaired again.
struct SecondSoup {
  TriangleSoup soup;
  // Of triangles and points, as Surface has them, of the soup that was given first.
  std::vector<std::uint32_t> source;
  std::vector<char> input_point;
  std::size_t first_added = 0;  // triangles from this one on are no result of the first repair

  SecondSoup() = default;
  // A result of the first repair.
  explicit SecondSoup(const Surface& surface)
      : soup(surface.mesh),
        source(surface.source),
        input_point(surface.input_point),
        first_added(surface.source.size()) {}

  // More triangles, each with its source.
  void append(const TriangleSoup& added, const std::vector<std::uint32_t>& sources);
  [[nodiscard]] bool empty() const { return source.empty(); }
};

// For the second repair: what is there winds around what is solid, and nothing is guessed.
[[nodiscard]] RepairOptions options_for_second(const SecondSoup& second,
                                               const RepairOptions& options);

// What the second repair made, as one of the soup that was given first.
void refer_to_first(const SecondSoup& second, Surface& surface);

// What the report of the second repair says about its result becomes part of that of the whole; all
// but `output`, see describe_result().
void append_report(RepairReport second, RepairReport& report);

}  // namespace meshrepair::internal
