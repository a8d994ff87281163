// SPDX-License-Identifier: MIT
// The page that the viewer is, as scripts/make_viewer.sh makes it, with one place for what it
// shows.
#pragma once

#include <string_view>

namespace meshrepair {

inline constexpr std::string_view kPlaceOfData = "@DATA@";  // a line of its own, once

[[nodiscard]] std::string_view viewer_page();

}  // namespace meshrepair
