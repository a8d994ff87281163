#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

#include <base/error.h>
#include <base/file_bytes.h>
#include <mesh/named_files.h>

namespace meshrepair {
namespace {

namespace fs = std::filesystem;

bool leads_out(const fs::path& path) {
  return path.empty() || path.has_root_path() || *path.begin() == "..";
}

void note_name(const MeshSource& source, std::string_view name,
               std::vector<std::string> NamesInFile::*kind) {
  if (source.names == nullptr || !source.folder || name.empty()) return;
  if (stays_within(name, source.levels_up)) {
    (source.names->*kind).push_back(fs::path(name).lexically_normal().generic_string());
  } else {
    source.names->outside.emplace_back(name);
  }
}

}  // namespace

bool stays_within(std::string_view name, std::size_t levels_up) {
  if (name.find('\0') != std::string_view::npos) return false;
  // Of another machine, or another drive.
  const std::size_t colon = name.find(':');
  const bool has_root = colon != std::string_view::npos && colon + 1 < name.size() &&
                        (name[colon + 1] == '/' || name[colon + 1] == '\\');
  const fs::path path = fs::path(name).lexically_normal();
  if (has_root || path.empty() || path.has_root_path()) return false;
  const auto up = std::count(path.begin(), path.end(), fs::path(".."));
  return static_cast<std::size_t>(up) <= levels_up;
}

std::size_t levels_below(const fs::path& root, const fs::path& folder) {
  const auto full = [](const fs::path& path) {
    return fs::absolute(path.empty() ? "." : path / ".").lexically_normal();
  };
  const fs::path way = full(folder).lexically_relative(full(root));
  if (leads_out(way)) return 0;
  return static_cast<std::size_t>(std::count_if(
      way.begin(), way.end(), [](const fs::path& part) { return !part.empty() && part != "."; }));
}

std::optional<fs::path> path_of_named(const MeshSource& source, std::string_view name) {
  if (!source.folder || !stays_within(name, source.levels_up)) return std::nullopt;
  return (*source.folder / fs::path(name).lexically_normal()).lexically_normal();
}

std::optional<fs::path> find_named(const MeshSource& source, std::string_view name) {
  std::optional<fs::path> path = path_of_named(source, name);
  if (!path) return std::nullopt;
  fs::path root = source.folder->empty() ? "." : *source.folder;
  for (std::size_t i = 0; i < source.levels_up; ++i) root /= "..";
  if (!is_file_within(root, *path)) return std::nullopt;
  return path;
}

bool is_file_within(const fs::path& folder, const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return false;
  const fs::path real_folder = fs::canonical(folder.empty() ? "." : folder, error);
  if (error) return false;
  const fs::path real = fs::canonical(path, error);
  return !error && !leads_out(real.lexically_relative(real_folder));
}

std::optional<NamedFile> read_named(const MeshSource& source, std::string_view name) {
  if (source.beside != nullptr) {
    const auto bytes = source.beside->bytes_of(name);
    if (!bytes) return std::nullopt;
    return NamedFile{*bytes, bytes, {}};
  }
  note_name(source, name, &NamesInFile::files);
  const std::optional<fs::path> path = find_named(source, name);
  if (!path) return std::nullopt;
  const auto file = std::make_shared<const FileBytes>(*path, source.options.progress);
  return NamedFile{file->bytes(), file, *path};
}

std::string_view place_of_named(const MeshSource& source) {
  return source.beside != nullptr ? "its archive" : "its folder";
}

void note_picture(const MeshSource& source, std::string_view name) {
  note_name(source, name, &NamesInFile::pictures);
}

Image picture_named(const MeshSource& source, std::string_view name) {
  Image image;
  image.name = fs::path(name).filename().string();
  note_picture(source, name);
  if (source.beside == nullptr) {
    if (const auto path = path_of_named(source, name)) image.path = path->string();
  } else {
    try {
      image.bytes = source.beside->bytes_of(name);
    } catch (const InputError&) {  // a picture less is no reason to refuse the mesh
    }
  }
  if (image.path.empty() && !image.bytes) image.name = name;
  return image;
}

std::string name_seen_from(const fs::path& folder, const fs::path& path) {
  const auto full = [](const fs::path& p) {
    std::error_code error;
    const fs::path absolute = fs::absolute(p.empty() ? "." : p);
    const fs::path real = fs::weakly_canonical(absolute, error);
    return error ? absolute.lexically_normal() : real;
  };
  return (full(path.parent_path()) / path.filename())
      .lexically_relative(full(folder))
      .generic_string();
}

}  // namespace meshrepair
