// SPDX-License-Identifier: MIT
// A std::vector whose resize() leaves new items without a value: for those that several threads
// fill in.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace meshrepair {

namespace internal {

template <class Value>
struct RawAllocator : std::allocator<Value> {
  static_assert(std::is_trivially_destructible_v<Value>);

  template <class Other>
  struct rebind {  // NOLINT(readability-identifier-naming): the standard's name
    using other = RawAllocator<Other>;
  };
  template <class Other>
  void construct(Other* /*item*/) noexcept {}
  template <class Other, class... From>
  void construct(Other* item, From&&... from) {
    ::new (static_cast<void*>(item)) Other(std::forward<From>(from)...);
  }
};

}  // namespace internal

template <class Value>
using RawVector = std::vector<Value, internal::RawAllocator<Value>>;

}  // namespace meshrepair
