// SPDX-License-Identifier: MIT
// Open-addressed index from keys that live in the caller's array to their positions in it.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace meshrepair::internal {

inline std::uint64_t hash_mix(std::uint64_t h, std::uint64_t value) {
  h = (h ^ value) * 0x9E3779B97F4A7C15u;
  return h ^ (h >> 29);
}

// Room for `expected` keys; at most half full then. For more of them the caller lets it grow.
// Positions only; keys are compared by the caller.
class HashIndex {
 public:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  explicit HashIndex(std::size_t expected)
      : slots_(std::bit_ceil(2 * expected + 16), kNone), mask_(slots_.size() - 1) {}

  // Whether one more key than these would fill more than half of it.
  [[nodiscard]] bool full(std::size_t keys) const { return 2 * (keys + 1) > slots_.size(); }

  // Twice the room, for the same keys: positions 0 to `keys` - 1, with these hashes.
  template <class Hash>
  void grow(std::uint32_t keys, Hash hash_at) {
    slots_.assign(2 * slots_.size(), kNone);
    mask_ = slots_.size() - 1;
    for (std::uint32_t position = 0; position < keys; ++position) {
      find_or_insert(hash_at(position), position, [](std::uint32_t) { return false; });
    }
  }

  // The position for which `same(position)` holds among keys with this hash, or `fresh`, which is
  // stored.
  template <class Same>
  std::uint32_t find_or_insert(std::uint64_t hash, std::uint32_t fresh, Same same) {
    std::size_t slot = (hash ^ (hash >> 32)) & mask_;
    while (slots_[slot] != kNone) {
      if (same(slots_[slot])) return slots_[slot];
      slot = (slot + 1) & mask_;
    }
    slots_[slot] = fresh;
    return fresh;
  }

  // The same without storing: kNone if there is none.
  template <class Same>
  [[nodiscard]] std::uint32_t find(std::uint64_t hash, Same same) const {
    std::size_t slot = (hash ^ (hash >> 32)) & mask_;
    while (slots_[slot] != kNone) {
      if (same(slots_[slot])) return slots_[slot];
      slot = (slot + 1) & mask_;
    }
    return kNone;
  }

 private:
  std::vector<std::uint32_t> slots_;
  std::size_t mask_;
};

}  // namespace meshrepair::internal
