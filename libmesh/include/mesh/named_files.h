// SPDX-License-Identifier: MIT
// Files that a mesh file names: buffers, libraries of materials, pictures.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <mesh/attributes.h>
#include <mesh/mesh_source.h>

namespace meshrepair {

// Whether a name, with '/' between folders, is a way to a file within the folder of whoever names
// it, or within that so many levels above: not "/a", "C:/a" or "https://a", "../a" from level 1.
[[nodiscard]] bool stays_within(std::string_view name, std::size_t levels_up = 0);

// How many levels a folder lies below another; 0 if it does not lie there.
[[nodiscard]] std::size_t levels_below(const std::filesystem::path& root,
                                       const std::filesystem::path& folder);

// Where the file is that has this name, relative to the folder of the source, with '/' between
// folders. Nothing if the source has no folder, or the name leads farther up than it may: names in
// files are not to be trusted. There need be no such file.
[[nodiscard]] std::optional<std::filesystem::path> path_of_named(const MeshSource& source,
                                                                 std::string_view name);

// The same, for a file that is there. No link leads farther, either.
[[nodiscard]] std::optional<std::filesystem::path> find_named(const MeshSource& source,
                                                              std::string_view name);

// The name that find_named() knows the file by that is meant: on other machines '\' stands between
// folders, and small letters are large ones. Some put names between quotes. The name itself where
// there is no such file, or several.
[[nodiscard]] std::string name_as_found(const MeshSource& source, std::string_view name);

// Whether read_named() finds a file.
[[nodiscard]] bool has_named(const MeshSource& source, std::string_view name);

// Whether there is a file that can be read again and again, and no link to it leads out of the
// folder; both as this process finds them.
[[nodiscard]] bool is_file_within(const std::filesystem::path& folder,
                                  const std::filesystem::path& path);

struct NamedFile {
  std::string_view bytes;
  std::shared_ptr<const void> owner;
  std::filesystem::path path;  // empty: it is in the archive of the source
};

// What is in a file that is found by name_as_found(), or that lies beside the source in its
// archive. Nothing if there is none. Throws InputError when it cannot be read.
[[nodiscard]] std::optional<NamedFile> read_named(const MeshSource& source, std::string_view name);

// Words for messages on files that are not there: "its folder", "its archive".
[[nodiscard]] std::string_view place_of_named(const MeshSource& source);

// A picture, without its type: its path, or its bytes if it is in the archive of the source. It has
// neither, but its whole name, where the name leads out, or there is no such file in the archive.
[[nodiscard]] Image picture_named(const MeshSource& source, std::string_view name);

// The name of the file at `path` as seen from a folder; both as this process finds them. Links to
// folders are followed.
[[nodiscard]] std::string name_seen_from(const std::filesystem::path& folder,
                                         const std::filesystem::path& path);

}  // namespace meshrepair
