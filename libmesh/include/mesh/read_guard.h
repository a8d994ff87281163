// SPDX-License-Identifier: MIT
// What a reader asks as it goes: whether it may go on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <base/error.h>
#include <mesh/mesh_source.h>

namespace meshrepair {

class ReadGuard {
 public:
  explicit ReadGuard(const MeshSource& source) : source_(source) {}

  // To be called for each element: with the triangles so far, and where in the bytes the reader
  // is. Throws LimitError, Cancelled.
  void step(std::size_t triangles, std::size_t position) {
    if (triangles > source_.options.max_triangles) fail(position);
    if (++steps_ % kStepsPerQuestion == 0) ask(position);
  }

  // For a reader that knows beforehand how many triangles there are.
  void require(std::uint64_t triangles) const {
    if (triangles > source_.options.max_triangles) fail(0);
  }

 private:
  static constexpr std::size_t kStepsPerQuestion = 4096;

  [[nodiscard]] double share(std::size_t position) const {
    return static_cast<double>(position) / static_cast<double>(source_.bytes.size());
  }

  void ask(std::size_t position) const {
    ProgressObserver* const progress = source_.options.progress;
    if (progress == nullptr) return;
    progress->advance(share(position));
    if (progress->cancelled()) throw Cancelled();
  }

  [[noreturn]] void fail(std::size_t position) const {
    throw LimitError(source_.name + ": limit of " +
                     counted(source_.options.max_triangles, "triangle") +
                     " reached in stage 'read', " +
                     std::to_string(static_cast<int>(100 * share(position))) + " % done");
  }

  const MeshSource& source_;
  std::size_t steps_ = 0;
};

}  // namespace meshrepair
