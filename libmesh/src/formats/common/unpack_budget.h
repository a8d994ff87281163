// SPDX-License-Identifier: MIT
// How much may come out of a packed file: some are made to fill all memory.
#pragma once

#include <cstddef>
#include <cstdint>

namespace meshrepair {

class UnpackBudget {
 public:
  // For a file of so many bytes.
  explicit UnpackBudget(std::size_t bytes) : left_(kAlwaysAllowed + kMostPerByte * bytes) {}

  [[nodiscard]] std::uint64_t left() const { return left_; }

  // False if it is more than is left.
  [[nodiscard]] bool take(std::uint64_t bytes) {
    if (bytes > left_) return false;
    left_ -= bytes;
    return true;
  }

 private:
  // Meshes are packed to a tenth, seldom to a fiftieth; deflate can do a thousandth, Zstandard
  // more, of one byte over and over. Small files may do as they like.
  static constexpr std::uint64_t kMostPerByte = 200;
  static constexpr std::uint64_t kAlwaysAllowed = std::uint64_t{32} << 20;

  std::uint64_t left_;
};

}  // namespace meshrepair
