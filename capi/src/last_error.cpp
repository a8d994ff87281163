// SPDX-License-Identifier: MIT
#include <string>

#include "handles.h"

namespace meshrepair {
namespace {

struct LastError {
  std::string text;
  const char* shown = "";  // the text, or what is said where there is no memory for it
};
thread_local LastError last_error;

}  // namespace

void clear_last_error() noexcept { last_error.shown = ""; }

meshrepair_code keep_last_error(const std::exception_ptr& error) noexcept {
  try {
    Failure failure = describe_failure(error);
    last_error.text = std::move(failure.message);
    last_error.shown = last_error.text.c_str();
    return static_cast<meshrepair_code>(failure.code);
  } catch (...) {
    last_error.shown = "out of memory";
    return MESHREPAIR_LIMIT;
  }
}

}  // namespace meshrepair

const char* meshrepair_last_error() { return meshrepair::last_error.shown; }
