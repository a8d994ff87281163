// SPDX-License-Identifier: MIT
// What files are packed in, beside the formats of meshes: gzip (.gz) and Zstandard (.zst), and ZIP
// archives, of which one mesh is read.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <base/progress.h>
#include <base/trivial_vector.h>
#include <base/warning.h>

namespace meshrepair {

struct MeshSource;

enum class Packing { none, gzip, zstd, zip };

// What a file that is read was packed in.
struct PackedFile {
  Packing packing = Packing::none;
  std::size_t bytes = 0;  // of the file as it was packed; 0: it was not
  std::string entry;      // of a ZIP archive: the name of the mesh in it
};

// "gzip", "zstd", "ZIP"; empty for none.
[[nodiscard]] std::string_view packing_name(Packing packing);

// As the first bytes tell. A 3MF file is a ZIP archive, too.
[[nodiscard]] Packing packing_of_content(std::string_view bytes);

// What a file of this name is packed in when it is written: .gz or .zst, else none. Case does not
// matter.
[[nodiscard]] Packing packing_of_extension(const std::filesystem::path& path);

// "part.obj" of "part.obj.gz". Other names stay.
[[nodiscard]] std::filesystem::path without_packing(const std::filesystem::path& path);

// The bytes in gzip or Zstandard, the same for the same; as they are for none. `progress` may be
// null; it is asked whether to go on. Throws Cancelled.
[[nodiscard]] std::string pack_bytes(std::string_view bytes, Packing packing,
                                     ProgressObserver* progress = nullptr);

// All that comes out of the source, whose options have the observer. What is behind the packed
// bytes but zeros is left out, with a warning. Throws InputError when they are damaged, cut off, or
// hold more than a file of this size should; Cancelled.
[[nodiscard]] TrivialVector<char> unpack(const MeshSource& source, Packing packing,
                                         std::vector<Warning>& warnings);

}  // namespace meshrepair
