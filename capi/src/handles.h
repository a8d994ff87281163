// SPDX-License-Identifier: MIT
// What is behind the handles of the C interface, and how its functions fail.
#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include <meshrepair.h>

#include "calls/session.h"
#include "steps/point_steps.h"

// The names of attributes as C has them: made anew whenever attributes change.
struct meshrepair_mesh {
  meshrepair::AnySoup it;
  std::vector<std::string> attribute_names;

  void name_attributes();
};

struct meshrepair_options {
  meshrepair::Keywords keywords;
  meshrepair_progress told = nullptr;
  void* data = nullptr;  // for `told`; the caller's
};

struct meshrepair_result {
  meshrepair::Outcome outcome;
  std::unique_ptr<meshrepair_mesh> mesh;  // may be null
  std::vector<std::uint32_t> sources;
  std::vector<std::uint16_t> marks;
};

namespace meshrepair {

// Forgets why an earlier function failed.
void clear_last_error() noexcept;
// Keeps what was thrown for meshrepair_last_error(), and returns its code.
meshrepair_code keep_last_error(const std::exception_ptr& error) noexcept;

// Runs what may throw, as no exception leaves a function of C.
template <class Work>
meshrepair_code guarded(const Work& work) noexcept {
  clear_last_error();
  try {
    work();
    return MESHREPAIR_DONE;
  } catch (...) {
    return keep_last_error(std::current_exception());
  }
}

}  // namespace meshrepair
