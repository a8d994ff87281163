// The text and the bytes of PLY files.
#pragma once

#include <string>
#include <string_view>

#include <mesh/soup_io.h>

namespace meshrepair {

// Properties of faces, and comments of the header, that readers know again.
inline constexpr std::string_view kPlySource = "source_triangle";
inline constexpr std::string_view kPlyMaterial = "material_index";
inline constexpr std::string_view kPlyTexture = "texnumber";
inline constexpr std::string_view kPlyTextureList = "texcoord";  // and a number, from the second on
inline constexpr std::string_view kPlyMaterialComment = "material";
inline constexpr std::string_view kPlyTextureComment = "TextureFile";

// Coordinates in double. Sources are the property `int source_triangle` of faces. Attributes are
// properties of points where each point has one value, else of faces where each triangle has one;
// texture coordinates with seams are lists `texcoord` of faces. Of other colours the first of each
// point is written; normals with creases, and groups, are left out. Materials are the property
// `int material_index`, whose names stand in comments; their textures, as other programs have them,
// `int texnumber` and comments `TextureFile`. A missing number is NaN, or 0 where that cannot be.
[[nodiscard]] std::string format_ply_binary(const TriangleSoup& soup, const SoupExtras& extras);
[[nodiscard]] std::string format_ply_ascii(const TriangleSoup& soup, const SoupExtras& extras);

}  // namespace meshrepair
