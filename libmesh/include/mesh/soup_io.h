// SPDX-License-Identifier: MIT
// Reading and writing of triangle soups: STL, OBJ, OFF and PLY in all their dialects, glTF, 3MF.
//
// Reading: the format is told by content first, then by extension. Coordinates are kept in double.
// STL corners with bit-identical coordinates (-0 is 0) are welded into one point; the points of
// indexed formats are kept as they are. Polygons are triangulated. The bytes decide, never a
// declared count: a file that holds less than it promises is read as far as it goes and the loss is
// counted, and no memory is taken for what the file cannot hold. Of files that a file names, only
// buffers of glTF are opened, and libraries of materials if attributes are asked for; none outside
// the folder, or that of ReadOptions::within.
//
// Writing: shortest decimal digits that read back as the same bits; every write is checked; the
// target appears atomically (a temporary file beside it, fsync, rename) unless it is a device or a
// pipe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/progress.h>
#include <mesh/reading.h>
#include <mesh/soup.h>
#include <mesh/soup_extras.h>

namespace meshrepair {

// Reads a file; "-" is standard input. Throws InputError (one line that names the file and the
// place) when it cannot be opened, is empty, or holds no format that is known, or no readable
// triangle at all, unless that may be; LimitError.
[[nodiscard]] ReadResult read_soup(const std::filesystem::path& path,
                                   const ReadOptions& options = {});

// The same from memory. `name` is used in messages and for its extension.
[[nodiscard]] ReadResult read_soup(std::string_view bytes, const std::string& name,
                                   const ReadOptions& options = {});

struct WriteOptions {
  // Empty: told by the extension.
  std::optional<SoupFormat> format = std::nullopt;
  SoupExtras extras = {};                // the folder is not asked for
  ProgressObserver* progress = nullptr;  // asked while the bytes are written whether to go on
  // Where the file and those beside it are written instead, as they are to be once they are moved.
  // Empty: where they belong.
  std::filesystem::path staging = {};
  // The folder that names of pictures are to be right from. Nothing: that of the file.
  std::optional<std::filesystem::path> names_from = std::nullopt;
};

// What of the attributes the format can hold. Formats with one list of names have groups or objects
// in it, whichever are more; glTF as objects, others as groups. `by_mesh`: objects are the meshes
// of a scene.
[[nodiscard]] Attributes held_by(SoupFormat format, Attributes attributes, bool by_mesh = false);

// Whether write_soup() would write others beside a file with these: libraries of materials. Neither
// standard output nor format_soup() has these.
[[nodiscard]] bool has_files_beside(SoupFormat format, const Attributes& attributes);

// Writes a file; "-" is standard output and needs options.format. Throws UsageError when no format
// can be told, or there are sources and it is not PLY; OutputError when anything cannot be written
// in full; the target is then as it was.
void write_soup(const TriangleSoup& soup, const std::filesystem::path& path,
                const WriteOptions& options = {});

// The bytes of the file. Coordinates are rounded to float32 where is_single(format).
[[nodiscard]] std::string format_soup(const TriangleSoup& soup, SoupFormat format,
                                      const SoupExtras& extras = {});

// The soup that a reader gets back from a file in this format: STL has no indices, so corners with
// equal coordinates become one point, and binary STL rounds coordinates to float32 before. For the
// other formats it is the soup itself.
[[nodiscard]] TriangleSoup as_read_back(const TriangleSoup& soup, SoupFormat format);

}  // namespace meshrepair
