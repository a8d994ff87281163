// SPDX-License-Identifier: MIT
// The facade: calls the reader or writer of a format.
#include <algorithm>
#include <system_error>
#include <utility>

#include <base/atomic_file.h>
#include <base/error.h>
#include <mesh/mesh_source.h>
#include <mesh/precision.h>
#include <mesh/soup_io.h>
#include <mesh/weld_points.h>

#include "formats/common/plain_names.h"
#include "formats/gltf/gltf_io.h"
#include "formats/obj/obj_io.h"
#include "formats/off/off_io.h"
#include "formats/ply/ply_io.h"
#include "formats/stl/stl_io.h"
#include "formats/threemf/threemf_io.h"
#include "held_attributes.h"
#include "mesh_readers.h"
#include "opened_file.h"

namespace meshrepair {
namespace {

ReadResult read_opened(const OpenedFile& file) {
  const MeshSource& source = file.source();
  ReadResult result = read_mesh_as(recognize_mesh(source), source);
  require_mesh(source, result);
  file.describe(result.report);
  result.report.names = file.names();
  return result;
}

// What comes last, which is the mesh.
void pack_as_named(BundledFile& mesh, const std::filesystem::path& path,
                   ProgressObserver* progress) {
  const Packing packing = packing_of_extension(path);
  if (packing != Packing::none) mesh.bytes = pack_bytes(mesh.bytes, packing, progress);
  mesh.path = path;
}

// What lies beside the mesh is not looked for names that are free there.
void stage(const std::filesystem::path& folder, std::vector<BundledFile>& files) {
  for (BundledFile& file : files) {
    file.path = folder / file.path.filename();
    if (&file != &files.back() && std::filesystem::exists(file.path)) {
      throw OutputError(file.path.string() + ": exists already, and is not overwritten");
    }
  }
}

// In this order, so that what the last names is there. Files that are new go again if one cannot be
// written.
void write_together(const std::vector<BundledFile>& files, ProgressObserver* progress) {
  std::vector<std::filesystem::path> fresh;
  try {
    for (const BundledFile& file : files) {
      const bool is_fresh = !std::filesystem::exists(file.path);
      write_file_atomically(file.path, file.bytes, progress);
      if (is_fresh) fresh.push_back(file.path);
    }
  } catch (...) {
    std::error_code ignored;
    for (const auto& path : fresh) std::filesystem::remove(path, ignored);
    throw;
  }
}

// Nothing where names do not stand in lines.
std::optional<NameLines> name_lines(SoupFormat format) {
  if (format == SoupFormat::obj) return NameLines::obj;
  if (format == SoupFormat::stl_ascii) return NameLines::stl;
  return holds_sources(format) ? std::optional(NameLines::ply) : std::nullopt;
}

// What is written of a soup, with names that fit into the lines of text formats.
class PlainExtras {
 public:
  PlainExtras(SoupFormat format, const SoupExtras& extras) : extras_(extras) {
    if (extras.attributes == nullptr) return;
    placed_ = placed_for(format, *extras.attributes);
    if (placed_) extras_.attributes = &*placed_;
    if (const auto lines = name_lines(format)) {
      plain_ = with_plain_names(*extras_.attributes, *lines);
    }
    if (plain_) extras_.attributes = &*plain_;
  }
  PlainExtras(const PlainExtras&) = delete;
  PlainExtras& operator=(const PlainExtras&) = delete;

  [[nodiscard]] const SoupExtras& get() const { return extras_; }

 private:
  std::optional<Attributes> placed_, plain_;
  SoupExtras extras_;
};

}  // namespace

ReadResult read_soup(const std::filesystem::path& path, const ReadOptions& options) {
  return read_opened(OpenedFile(path, options));
}

ReadResult read_soup(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  return read_opened(OpenedFile(bytes, name, options));
}

bool has_files_beside(SoupFormat format, const Attributes& attributes) {
  return format == SoupFormat::obj &&
         obj_files({}, {.attributes = &attributes}, "mesh.obj").size() > 1;
}

void write_soup(const TriangleSoup& soup, const std::filesystem::path& path,
                const WriteOptions& options) {
  const auto format = options.format ? options.format : format_of_extension(path);
  if (!format) {
    throw UsageError(path.string() + ": no mesh format has this extension (" +
                     std::string(known_extensions()) + "; .gz or .zst behind it packs)");
  }
  SoupExtras extras = options.extras;
  extras.folder = options.names_from.value_or(path.parent_path());
  std::vector<BundledFile> files;
  if (*format == SoupFormat::obj && extras.attributes != nullptr && path != "-") {
    files = obj_files(soup, PlainExtras(*format, extras).get(), without_packing(path));
  } else {
    files.push_back({path, format_soup(soup, *format, extras)});
  }
  pack_as_named(files.back(), path, options.progress);
  if (!options.staging.empty() && path != "-") stage(options.staging, files);
  write_together(files, options.progress);
}

std::string format_soup(const TriangleSoup& soup, SoupFormat format, const SoupExtras& all) {
  const PlainExtras plain(format, all);
  const SoupExtras& extras = plain.get();
  if (!extras.sources.empty() && !holds_sources(format)) {
    throw UsageError(std::string(format_name(format)) + " cannot hold the sources of triangles");
  }
  switch (format) {
    case SoupFormat::stl_binary:
      return format_stl_binary(soup, extras.attributes);
    case SoupFormat::stl_ascii:
      return format_stl_ascii(soup, extras.attributes);
    case SoupFormat::obj:
      return format_obj(soup, extras);
    case SoupFormat::off:
      return format_off(soup, extras.comments);
    case SoupFormat::ply_binary:
      return format_ply_binary(soup, extras);
    case SoupFormat::threemf:
      return format_threemf(soup, extras);
    case SoupFormat::ply_ascii:
      return format_ply_ascii(soup, extras);
    case SoupFormat::glb:
    case SoupFormat::gltf:
      break;
  }
  return format_gltf(soup, extras, format == SoupFormat::glb);
}

TriangleSoup as_read_back(const TriangleSoup& soup, SoupFormat format) {
  if (!welds_points(format)) return soup;
  TriangleSoup welded;
  PointWelder welder(welded.points, soup.points.size());
  std::vector<std::uint32_t> index;
  index.reserve(soup.points.size());
  for (const Vec3d& p : soup.points) {
    index.push_back(welder.index_of(is_single(format) ? rounded_to_float32(p) : p));
  }
  welded.triangles.reserve(soup.triangles.size());
  for (const auto& t : soup.triangles) {
    welded.triangles.push_back({index[t[0]], index[t[1]], index[t[2]]});
  }
  return welded;
}

}  // namespace meshrepair
