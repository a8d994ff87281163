// Files that a mesh file names: buffers, libraries of materials, pictures.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include <mesh/mesh_source.h>

namespace meshrepair {

// Where the file is that has this name, relative to the folder of the source, with '/' between
// folders. Nothing if the source has no folder, or the name leads out of it: names in files are
// not to be trusted. There need be no such file.
[[nodiscard]] std::optional<std::filesystem::path> path_of_named(const MeshSource& source,
                                                                 std::string_view name);

// The same, for a file that is there. No link leads out of the folder, either.
[[nodiscard]] std::optional<std::filesystem::path> find_named(const MeshSource& source,
                                                              std::string_view name);

// Whether there is a file that can be read again and again, and no link to it leads out of the
// folder; both as this process finds them.
[[nodiscard]] bool is_file_within(const std::filesystem::path& folder,
                                  const std::filesystem::path& path);

// The name of the file at `path` as seen from a folder; both as this process finds them.
[[nodiscard]] std::string name_seen_from(const std::filesystem::path& folder,
                                         const std::filesystem::path& path);

}  // namespace meshrepair
