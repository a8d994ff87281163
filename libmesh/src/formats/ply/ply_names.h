// SPDX-License-Identifier: MIT
// Names in PLY files that others do not have, or not all.
#pragma once

#include <string_view>

namespace meshrepair {

// Properties of faces, and comments of the header, that readers know again.
inline constexpr std::string_view kPlySource = "source_triangle";
inline constexpr std::string_view kPlyMaterial = "material_index";
inline constexpr std::string_view kPlyGroup = "group_index";
inline constexpr std::string_view kPlyObject = "object_index";
inline constexpr std::string_view kPlyTexture = "texnumber";
inline constexpr std::string_view kPlyTextureList = "texcoord";  // and a number, from the second on
inline constexpr std::string_view kPlyMaterialComment = "material";
inline constexpr std::string_view kPlyGroupComment = "group";
inline constexpr std::string_view kPlyObjectComment = "object";
inline constexpr std::string_view kPlyTextureComment = "TextureFile";

}  // namespace meshrepair
