// SPDX-License-Identifier: MIT
// The .mtl files that an OBJ file names.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <mesh/attributes.h>
#include <mesh/mesh_source.h>

#include "formats/common/bundled_file.h"

namespace meshrepair {

// Their text, for other OBJ files.
struct MaterialLibraries final : Keepsake {
  struct Library {
    std::string name;              // as the OBJ file has it, or as it was found
    std::filesystem::path path;    // empty: it was not found, or in an archive
    std::filesystem::path folder;  // which names of pictures are relative to
    std::size_t levels_up = 0;     // from there, that they may lead
    std::string text;
    bool is_packed = false;  // it was in an archive
    // Those of the archive, by the names that the text has for them.
    std::map<std::string, std::shared_ptr<const std::string>, std::less<>> pictures;
    // Where pictures lie whose names the text has in another form.
    std::map<std::string, std::filesystem::path, std::less<>> real_names;

    // Says the same.
    [[nodiscard]] bool is_like(const Library& other) const;
  };
  std::vector<Library> libraries;

  // Keys of lines.
  [[nodiscard]] std::vector<std::string> lost_in(SoupFormat format) const override;
  // Materials of one name that are not the same get different ones.
  [[nodiscard]] std::shared_ptr<const Keepsake> appended_to(
      const Keepsake* first, AppendedMaterials& materials) const override;
};

// Reads the libraries that these lines name, as far as they lie where names may lead:
// the looks of the attributes' materials, their images, and the keepsake. Warns of others.
void read_material_libraries(const MeshSource& source, const std::vector<std::string>& lines,
                             Attributes& attributes, ReadReport& report);

// What a mesh at `path` that is written as OBJ needs beside it: one library for all materials, in
// which names of pictures are relative to another folder, and the pictures that are no files yet.
// The library comes last. Nothing where nothing is known of the materials. No file that the
// libraries were read from is among them, unless its text stays as it is.
[[nodiscard]] std::vector<BundledFile> material_files(const std::filesystem::path& path,
                                                      const std::filesystem::path& names_from,
                                                      const Attributes& attributes);

// Lines that name libraries that could not be read, as they were.
[[nodiscard]] std::string unread_libraries(const Attributes& attributes);

}  // namespace meshrepair
