// SPDX-License-Identifier: MIT
// Files of several bodies with common faces, each face once: for meshers and for simulation.
//
// | format | holds |
// |---|---|
// | PLY | `front` and `behind` of each face: the numbers of its regions, 0 outside; names in
// comments | | OBJ | groups: `g A` for faces of one region, `g A B` for those between A and B | |
// VTP | VTK's PolyData, as text, with `front` and `behind` as cell data | | POLY | TetGen's: a
// marker for each pair of regions, a seed for each region, a hole for each void | | MSH |
// Gmsh's 4.1, as text: a surface for each pair of regions, a volume for each region, named |
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <mesh/soup.h>

namespace meshrepair {

enum class RegionFormat { ply, obj, vtp, poly, msh };

// By the extension, in any case; nothing for others.
[[nodiscard]] std::optional<RegionFormat> region_format_of(std::string_view path);
// "PLY", "OBJ", "VTP", "POLY", "MSH".
[[nodiscard]] std::string_view region_format_name(RegionFormat format);

// A place inside a part of a region, or, with region 0, inside a void.
struct RegionSeed {
  std::uint32_t region = 0;
  Vec3d place = Vec3d::Zero();
};

// Not owned. Regions fall into connected parts. Part 0 is the unbounded outside; other parts of
// region 0 are voids. Triangles are counter-clockwise seen from the part in front.
struct RegionMesh {
  const TriangleSoup& mesh;
  std::span<const std::array<std::uint32_t, 2>> parts_of;  // of each triangle: in front, behind
  std::span<const std::uint32_t> region_of_part;
  std::span<const std::string> names;  // of the regions from number 1 on
  std::span<const RegionSeed> seeds;

  // Of a triangle, in front and behind.
  [[nodiscard]] std::array<std::uint32_t, 2> regions_of(std::size_t t) const {
    return {region_of_part[parts_of[t][0]], region_of_part[parts_of[t][1]]};
  }
};

// The bytes of the file. Triangles come by their pairs of regions, (0, 1) first, but for PLY and
// VTP. `comments` are lines without newlines. In the names of OBJ and MSH, what would end a name
// there is an underscore.
[[nodiscard]] std::string format_region_mesh(const RegionMesh& regions, RegionFormat format,
                                             std::span<const std::string> comments = {});

// The script that makes volumes of the surfaces in a MSH file of these regions, which Gmsh cannot
// read from there: for a file in the same folder. `msh` is the name of that file.
[[nodiscard]] std::string format_gmsh_script(const RegionMesh& regions, std::string_view msh);

}  // namespace meshrepair
