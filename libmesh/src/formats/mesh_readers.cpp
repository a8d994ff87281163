// SPDX-License-Identifier: MIT
#include "mesh_readers.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <base/error.h>
#include <mesh/mesh_limits.h>
#include <mesh/recognize_format.h>
#include <mesh/soup_io.h>

#include "formats/common/text_scanner.h"
#include "formats/gltf/gltf_io.h"
#include "formats/obj/obj_io.h"
#include "formats/off/off_io.h"
#include "formats/ply/ply_io.h"
#include "formats/stl/stl_io.h"
#include "formats/threemf/threemf_io.h"

namespace meshrepair {
namespace {

void require_some(const MeshSource& source, const ReadResult& result) {
  if (!result.soup.triangles.empty()) return;
  const ReadReport& report = result.report;
  const bool is_empty = result.soup.points.empty() && report.bad_faces == 0 &&
                        report.missing_faces == 0 &&
                        (report.warnings.empty() || !report.volumes.empty());
  if (is_empty && source.options.may_be_empty) return;
  std::string what = "holds no triangles";
  if (report.bad_faces > 0) {
    what = "holds no readable faces";
  } else if (!welds_points(report.format) && !result.soup.points.empty()) {
    what = "holds " + counted(result.soup.points.size(), "point") + " but no faces";
  }
  if (!report.warnings.empty()) what += " (" + report.warnings.front().text + ")";
  source.fail(what);
}

void require_limits(const MeshSource& source, const TriangleSoup& soup) {
  require_points(soup.points.size(), source.name);
  require_triangles(soup.triangles.size(), source.name);
}

ReadResult read_format(SoupFormat format, const MeshSource& source) {
  switch (format) {
    case SoupFormat::stl_binary:
      return read_stl_binary(source);
    case SoupFormat::stl_ascii:
      return read_stl_ascii(source);
    case SoupFormat::obj:
      return read_obj(source);
    case SoupFormat::off:
      return read_off(source);
    case SoupFormat::threemf:
      return read_threemf(source);
    case SoupFormat::ply_binary:
    case SoupFormat::ply_ascii:
      return read_ply(source);
    case SoupFormat::glb:
    case SoupFormat::gltf:
      break;
  }
  return read_gltf(source);
}

// Its objects are the meshes, solids of STL, too; and their names stay in any case.
ReadResult read_by_object(SoupFormat format, const MeshSource& source) {
  MeshSource with_objects = source;
  with_objects.options.attributes = true;
  ReadResult result = read_format(format, with_objects);
  const bool has_solids = format == SoupFormat::stl_ascii || format == SoupFormat::stl_binary;
  if (has_solids) std::swap(result.attributes.objects, result.attributes.groups);
  result.scene = split_objects(result.soup, result.attributes);
  if (!source.options.attributes) {
    Attributes objects;
    objects.objects = std::move(result.attributes.objects);
    result.attributes = std::move(objects);
  }
  return result;
}

}  // namespace

// By content, then by extension.
SoupFormat recognize_mesh(const MeshSource& source) {
  if (const auto format = recognize_content(source.bytes)) return *format;
  if (looks_like_tree(source.bytes)) {
    source.fail("is a BSP tree, not a mesh: bspsolid and bspextract take it further");
  }
  const std::string_view foreign = name_foreign_format(source.bytes);
  if (!foreign.empty()) source.fail("is " + std::string(foreign) + ", which cannot be read");
  const auto format = format_of_extension(source.name);
  if (!format)
    source.fail(
        "is in no known format: neither a mesh (STL, OBJ, OFF, PLY, glTF, 3MF) nor points (XYZ, "
        "PTS, "
        "PWN, "
        "PCD, PLY, OBJ)");
  const bool is_text = looks_like_text(source.bytes);
  if (*format == SoupFormat::stl_binary && is_text) return SoupFormat::stl_ascii;
  if (*format == SoupFormat::glb) source.fail("does not begin with 'glTF' as a .glb file does");
  if (*format == SoupFormat::ply_binary)
    source.fail("does not begin with 'ply' as a PLY file does");
  if (*format == SoupFormat::threemf) source.fail("is not 3MF: it is no ZIP archive");
  if (*format != SoupFormat::stl_binary && !is_text) {
    source.fail("is not " + std::string(format_name(*format)) +
                ": it holds bytes that are no text");
  }
  return *format;
}

ReadResult read_mesh_as(SoupFormat format, const MeshSource& source) {
  if (source.options.by_mesh && !has_instances(format)) return read_by_object(format, source);
  return read_format(format, source);
}

void require_mesh(const MeshSource& source, const ReadResult& result) {
  require_some(source, result);
  require_limits(source, result.soup);
}

}  // namespace meshrepair
