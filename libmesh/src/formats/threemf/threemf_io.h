// SPDX-License-Identifier: MIT
// 3MF, the 3D Manufacturing Format: a ZIP archive by the Open Packaging Conventions, in which XML
// describes objects, what they look like, and which of them are built where.
#pragma once

#include <string>
#include <string_view>

#include <mesh/mesh_source.h>
#include <mesh/reading.h>
#include <mesh/soup.h>
#include <mesh/soup_extras.h>

namespace meshrepair {

// Begins as a ZIP archive does.
[[nodiscard]] bool begins_with_zip(std::string_view bytes);

// Is a ZIP archive with a part that is a 3D model.
[[nodiscard]] bool is_threemf(std::string_view bytes);

// The objects that the build of the first model names, with their components, where their
// transforms put them, as one soup in the file's unit; objects of the types "other" and "support"
// are left out. Models in other parts are read as far as they are named (production extension).
// Attributes, if asked for: base materials, textures, colours, names of objects, and a keepsake
// with the unit, the metadata and the other parts of the package.
//
// Archives are not trusted: see ZipReader and XmlStream for their limits, and place_instances() for
// those of components.
[[nodiscard]] ReadResult read_threemf(const MeshSource& source);

// Whether it is there, and of a type that packages hold: PNG or JPEG.
[[nodiscard]] bool can_be_in_threemf(const Image& image);

// A package with one object, or those of the scene. Of attributes it holds materials, colours in
// eight bits where all three corners have one, coordinates in textures where the material has a
// picture in PNG or JPEG, the name of an object if it is the only one, and the keepsake of another
// 3MF. Throws OutputError where a coordinate is no finite number: the format has none.
[[nodiscard]] std::string format_threemf(const TriangleSoup& soup, const SoupExtras& extras);

}  // namespace meshrepair
