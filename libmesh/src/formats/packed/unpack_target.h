// SPDX-License-Identifier: MIT
// Where unpacked bytes go: memory that grows as they come.
#pragma once

#include <cstddef>
#include <span>

#include <base/trivial_vector.h>
#include <mesh/mesh_source.h>

#include "formats/common/unpack_budget.h"

namespace meshrepair {

class UnpackTarget {
 public:
  // The source has to stay.
  explicit UnpackTarget(const MeshSource& source) : source_(source), budget_(source.bytes.size()) {}

  [[nodiscard]] const UnpackBudget& budget() const { return budget_; }

  // For the next bytes; never empty.
  [[nodiscard]] std::span<char> room();

  // So many bytes of the last room were filled; so many of the source's are left. Throws InputError
  // when it is too much, Cancelled.
  void filled(std::size_t count, std::size_t left);

  [[nodiscard]] TrivialVector<char> take() { return std::move(bytes_); }

 private:
  const MeshSource& source_;
  UnpackBudget budget_;
  TrivialVector<char> bytes_;
  std::size_t done_at_question_ = 0;  // bytes read and filled
};

}  // namespace meshrepair
