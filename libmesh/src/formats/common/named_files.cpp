#include <system_error>

#include <mesh/named_files.h>

namespace meshrepair {
namespace {

namespace fs = std::filesystem;

bool leads_out(const fs::path& path) {
  return path.empty() || path.has_root_path() || *path.begin() == "..";
}

}  // namespace

std::optional<fs::path> path_of_named(const MeshSource& source, std::string_view name) {
  if (!source.folder || name.find('\0') != std::string_view::npos) return std::nullopt;
  const fs::path path = fs::path(name).lexically_normal();
  if (leads_out(path)) return std::nullopt;
  return (*source.folder / path).lexically_normal();
}

std::optional<fs::path> find_named(const MeshSource& source, std::string_view name) {
  std::optional<fs::path> path = path_of_named(source, name);
  if (!path || !is_file_within(*source.folder, *path)) return std::nullopt;
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

std::string name_seen_from(const fs::path& folder, const fs::path& path) {
  const auto full = [](const fs::path& p) {
    return fs::absolute(p.empty() ? "." : p).lexically_normal();
  };
  return full(path).lexically_relative(full(folder)).generic_string();
}

}  // namespace meshrepair
