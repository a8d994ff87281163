// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>
#include <system_error>
#include <utility>
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

// As Windows separates folders.
std::string with_usual_slashes(std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

// Windows has no names with such.
std::string without_quotes(std::string name) {
  std::erase(name, '"');
  return name;
}

bool is_same_but_for_case(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

// The only entry of a folder that has this name in small or large letters.
std::optional<fs::path> entry_in_other_case(const fs::path& folder, const std::string& name) {
  std::optional<fs::path> found;
  std::error_code error;
  fs::directory_iterator entries(folder.empty() ? "." : folder, error), end;
  for (; !error && entries != end; entries.increment(error)) {
    fs::path entry = entries->path().filename();
    if (!is_same_but_for_case(entry.string(), name)) continue;
    if (found) return std::nullopt;
    found = std::move(entry);
  }
  return found;
}

// Pre: it stays within.
std::optional<std::string> name_in_other_case(const MeshSource& source, const std::string& name) {
  fs::path found;
  for (const fs::path& part : fs::path(name).lexically_normal()) {
    std::error_code error;
    const fs::path folder = *source.folder / found;
    if (part == ".." || fs::exists(folder / part, error)) {
      found /= part;
    } else if (const auto entry = entry_in_other_case(folder, part.string())) {
      found /= *entry;
    } else {
      return std::nullopt;
    }
  }
  return find_named(source, found.generic_string()) ? std::optional(found.generic_string())
                                                    : std::nullopt;
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
  const fs::path& root = source.levels_up > 0 ? source.options.within : *source.folder;
  if (!is_file_within(root, *path)) return std::nullopt;
  return path;
}

std::string name_as_found(const MeshSource& source, std::string_view given) {
  std::string name(given);
  std::string meant = without_quotes(with_usual_slashes(name));
  if (source.beside != nullptr) {
    const bool is_other = meant != name && source.beside->bytes_of(name) == nullptr;
    return is_other && source.beside->bytes_of(meant) != nullptr ? meant : name;
  }
  if (!path_of_named(source, meant) || find_named(source, name)) return name;
  if (find_named(source, meant)) return meant;
  return name_in_other_case(source, meant).value_or(name);
}

bool has_named(const MeshSource& source, std::string_view name) {
  const std::string found = name_as_found(source, name);
  if (source.beside != nullptr) return source.beside->bytes_of(found) != nullptr;
  return find_named(source, found).has_value();
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
  const std::string found = name_as_found(source, name);
  if (source.beside != nullptr) {
    const auto bytes = source.beside->bytes_of(found);
    if (!bytes) return std::nullopt;
    return NamedFile{*bytes, bytes, {}};
  }
  note_name(source, found, &NamesInFile::files);
  const std::optional<fs::path> path = find_named(source, found);
  if (!path) return std::nullopt;
  const auto file = std::make_shared<const FileBytes>(*path, source.options.progress);
  return NamedFile{file->bytes(), file, *path};
}

std::string_view place_of_named(const MeshSource& source) {
  return source.beside != nullptr ? "its archive" : "its folder";
}

Image picture_named(const MeshSource& source, std::string_view name) {
  Image image;
  std::string found(name);
  try {
    found = name_as_found(source, name);
    if (source.beside != nullptr) image.bytes = source.beside->bytes_of(found);
  } catch (const InputError&) {  // a picture less is no reason to refuse the mesh
  }
  note_name(source, found, &NamesInFile::pictures);
  if (const auto path = path_of_named(source, found)) {
    std::error_code error;
    image.path = path->string();
    image.is_elsewhere = fs::exists(*path, error) && !find_named(source, found);
  }
  const bool is_known = !image.path.empty() || image.bytes != nullptr;
  image.name = is_known ? fs::path(found).filename().string() : std::string(name);
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
