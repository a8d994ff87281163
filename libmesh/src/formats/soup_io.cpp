// The facade: calls the reader or writer of a format.
#include <algorithm>
#include <array>
#include <utility>

#include <base/atomic_file.h>
#include <base/error.h>
#include <base/file_bytes.h>
#include <mesh/float32.h>
#include <mesh/mesh_source.h>
#include <mesh/soup_io.h>
#include <mesh/weld_points.h>

#include "formats/common/text_scanner.h"
#include "formats/obj/obj_io.h"
#include "formats/off/off_io.h"
#include "formats/ply/ply_io.h"
#include "formats/stl/stl_io.h"
#include "mesh_readers.h"

namespace meshrepair {

std::string_view format_name(SoupFormat format) {
  switch (format) {
    case SoupFormat::stl_binary:
      return "binary STL";
    case SoupFormat::stl_ascii:
      return "ASCII STL";
    case SoupFormat::obj:
      return "OBJ";
    case SoupFormat::off:
      return "OFF";
    case SoupFormat::ply_binary:
      return "binary PLY";
    case SoupFormat::ply_ascii:
      break;
  }
  return "ASCII PLY";
}

std::optional<SoupFormat> format_of_extension(const std::filesystem::path& path) {
  constexpr std::array<std::pair<std::string_view, SoupFormat>, 4> kExtensions = {{
      {".stl", SoupFormat::stl_binary},
      {".obj", SoupFormat::obj},
      {".off", SoupFormat::off},
      {".ply", SoupFormat::ply_binary},
  }};
  const std::string extension = path.extension().string();
  for (const auto& [name, format] : kExtensions) {
    if (equals_ignoring_case(extension, name)) return format;
  }
  return std::nullopt;
}

ReadResult read_soup(const std::filesystem::path& path, const ReadOptions& options) {
  const FileBytes file(path, options.progress);
  return read_soup(file.bytes(), path == "-" ? "standard input" : path.string(), options);
}

ReadResult read_soup(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  const MeshSource source = {without_byte_order_mark(bytes), name, options};
  if (source.bytes.empty()) source.fail("is empty");
  ReadResult result = read_mesh_as(recognize_mesh(source), source);
  result.report.bytes = bytes.size();
  require_mesh(source, result);
  return result;
}

bool is_stl(SoupFormat format) {
  return format == SoupFormat::stl_binary || format == SoupFormat::stl_ascii;
}

bool is_ply(SoupFormat format) {
  return format == SoupFormat::ply_binary || format == SoupFormat::ply_ascii;
}

void write_soup(const TriangleSoup& soup, const std::filesystem::path& path,
                const WriteOptions& options) {
  const auto format = options.format ? options.format : format_of_extension(path);
  if (!format) {
    throw UsageError(path.string() +
                     ": no mesh format has this extension (.stl, .obj, .off, .ply)");
  }
  write_file_atomically(
      path, format_soup(soup, *format, options.comments, options.sources, options.attributes),
      options.progress);
}

std::string format_soup(const TriangleSoup& soup, SoupFormat format,
                        const std::vector<std::string>& comments,
                        std::span<const std::uint32_t> sources, const Attributes* attributes) {
  if (!sources.empty() && !is_ply(format)) {
    throw UsageError(std::string(format_name(format)) + " cannot hold the sources of triangles");
  }
  switch (format) {
    case SoupFormat::stl_binary:
      return format_stl_binary(soup);
    case SoupFormat::stl_ascii:
      return format_stl_ascii(soup);
    case SoupFormat::obj:
      return format_obj(soup, comments, attributes);
    case SoupFormat::off:
      return format_off(soup, comments);
    case SoupFormat::ply_binary:
      return format_ply_binary(soup, comments, sources);
    case SoupFormat::ply_ascii:
      break;
  }
  return format_ply_ascii(soup, comments, sources);
}

TriangleSoup as_read_back(const TriangleSoup& soup, SoupFormat format) {
  if (!is_stl(format)) return soup;
  TriangleSoup welded;
  PointWelder welder(welded.points, soup.points.size());
  std::vector<std::uint32_t> index;
  index.reserve(soup.points.size());
  for (const Vec3d& p : soup.points) {
    index.push_back(welder.index_of(format == SoupFormat::stl_binary ? rounded_to_float32(p) : p));
  }
  welded.triangles.reserve(soup.triangles.size());
  for (const auto& t : soup.triangles) {
    welded.triangles.push_back({index[t[0]], index[t[1]], index[t[2]]});
  }
  return welded;
}

}  // namespace meshrepair
