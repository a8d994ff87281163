// SPDX-License-Identifier: MIT
// Giving back memory early.
#pragma once

namespace meshrepair {

// The container is empty afterwards, and without room. Assigning {} to a std::vector keeps its
// room.
template <class Container>
void release(Container& container) {
  Container().swap(container);
}

}  // namespace meshrepair
