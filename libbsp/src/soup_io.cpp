// The facade: recognises the format, calls its reader or writer, and judges what a reader found.
#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include <bsp/atomic_file.h>
#include <bsp/error.h>
#include <bsp/float32.h>
#include <bsp/soup_io.h>
#include <bsp/tree_io.h>
#include <bsp/weld_points.h>

#include "file_bytes.h"
#include "mesh_source.h"
#include "obj_io.h"
#include "off_io.h"
#include "ply_header.h"
#include "ply_io.h"
#include "recognize_format.h"
#include "stl_io.h"
#include "text_scanner.h"

namespace meshrepair {
namespace {

std::string_view without_byte_order_mark(std::string_view bytes) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  return bytes.starts_with(kMark) ? bytes.substr(kMark.size()) : bytes;
}

// By content, then by extension.
SoupFormat recognize(const MeshSource& source) {
  if (const auto format = recognize_content(source.bytes)) return *format;
  if (looks_like_tree(source.bytes)) {
    source.fail("is a BSP tree, not a mesh: bspsolid and bspextract take it further");
  }
  const std::string_view foreign = name_foreign_format(source.bytes);
  if (!foreign.empty()) source.fail("is " + std::string(foreign) + ", which cannot be read");
  const auto format = format_of_extension(source.name);
  if (!format) source.fail("is in no known mesh format (STL, OBJ, OFF, PLY)");
  const bool is_text = looks_like_text(source.bytes);
  if (*format == SoupFormat::stl_binary && is_text) return SoupFormat::stl_ascii;
  if (*format == SoupFormat::ply_binary)
    source.fail("does not begin with 'ply' as a PLY file does");
  if (*format != SoupFormat::stl_binary && !is_text) {
    source.fail("is not " + std::string(format_name(*format)) +
                ": it holds bytes that are no text");
  }
  return *format;
}

ReadResult read_as(SoupFormat format, const MeshSource& source) {
  switch (format) {
    case SoupFormat::stl_binary:
      return read_stl_binary(source);
    case SoupFormat::stl_ascii:
      return read_stl_ascii(source);
    case SoupFormat::obj:
      return read_obj(source);
    case SoupFormat::off:
      return read_off(source);
    default:
      return read_ply(source);
  }
}

void require_triangles(const MeshSource& source, const ReadResult& result) {
  if (!result.soup.triangles.empty()) return;
  const ReadReport& report = result.report;
  const bool is_stl =
      report.format == SoupFormat::stl_binary || report.format == SoupFormat::stl_ascii;
  std::string what = "holds no triangles";
  if (report.bad_faces > 0) {
    what = "holds no readable faces";
  } else if (!is_stl && !result.soup.points.empty()) {
    what = "holds " + counted(result.soup.points.size(), "point") + " but no faces";
  }
  if (!report.warnings.empty()) what += " (" + report.warnings.front() + ")";
  source.fail(what);
}

void require_32_bit_ids(const MeshSource& source, const TriangleSoup& soup) {
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max() - 1;
  if (std::max(soup.points.size(), soup.triangles.size()) > kMost) {
    throw LimitError(source.name + ": more than 4294967294 points or triangles");
  }
}

}  // namespace

std::string_view format_name(SoupFormat format) {
  constexpr std::array<std::string_view, 6> kNames = {"binary STL", "ASCII STL",  "OBJ",
                                                      "OFF",        "binary PLY", "ASCII PLY"};
  return kNames[static_cast<std::size_t>(format)];
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
  ReadResult result = read_as(recognize(source), source);
  result.report.bytes = bytes.size();
  require_triangles(source, result);
  require_32_bit_ids(source, result.soup);
  return result;
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
  write_file_atomically(path, format_soup(soup, *format, options.comments, options.sources),
                        options.progress);
}

std::string format_soup(const TriangleSoup& soup, SoupFormat format,
                        const std::vector<std::string>& comments,
                        std::span<const std::uint32_t> sources) {
  if (!sources.empty() && !is_ply(format)) {
    throw UsageError(std::string(format_name(format)) + " cannot hold the sources of triangles");
  }
  switch (format) {
    case SoupFormat::stl_binary:
      return format_stl_binary(soup);
    case SoupFormat::stl_ascii:
      return format_stl_ascii(soup);
    case SoupFormat::obj:
      return format_obj(soup, comments);
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
  if (format != SoupFormat::stl_binary && format != SoupFormat::stl_ascii) return soup;
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
