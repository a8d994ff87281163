// SPDX-License-Identifier: MIT
// The page that hands in meshes and shows what came of them, with its script and style.
#pragma once

#include <string_view>

namespace meshrepair {

[[nodiscard]] std::string_view serve_page();
[[nodiscard]] std::string_view serve_script();
[[nodiscard]] std::string_view serve_style();

}  // namespace meshrepair
