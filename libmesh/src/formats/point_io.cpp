// SPDX-License-Identifier: MIT
// The facade: tells point clouds from meshes, calls the reader of a format, and judges what it
// found.
#include <algorithm>
#include <array>
#include <utility>

#include <base/error.h>
#include <mesh/mesh_limits.h>
#include <mesh/mesh_source.h>
#include <mesh/point_io.h>
#include <mesh/recognize_format.h>

#include "formats/common/text_scanner.h"
#include "formats/obj/obj_io.h"
#include "formats/pcd/pcd_points.h"
#include "formats/ply/ply_io.h"
#include "formats/xyz/xyz_points.h"
#include "mesh_readers.h"
#include "opened_file.h"

namespace meshrepair {
namespace {

// An OFF without its first line begins with numbers, too; then the extension decides.
bool is_point_text(const MeshSource& source) {
  if (!begins_with_points(source.bytes)) return false;
  return has_point_extension(source.name) || !recognize_content(source.bytes);
}

// By its format alone.
bool is_point_cloud(const MeshSource& source) {
  return begins_with_pcd(source.bytes) || is_ply_of_points(source) || is_point_text(source);
}

// What is read has no faces, and none were promised or damaged. STL has no points of its own.
bool is_without_faces(const ReadResult& result) {
  const ReadReport& report = result.report;
  const bool has_points = report.format == SoupFormat::obj || report.format == SoupFormat::off;
  return has_points && result.soup.triangles.empty() && !result.soup.points.empty() &&
         report.bad_faces == 0 && report.declared_triangles == 0;
}

// The corners of a mesh.
PointReadResult corners_of(ReadResult mesh) {
  PointReadResult result;
  result.cloud.points = std::move(mesh.soup.points);
  result.report.bad_points = mesh.report.bad_points;
  result.report.warnings = std::move(mesh.report.warnings);
  result.report.format =
      mesh.report.format == SoupFormat::off ? PointFormat::off : PointFormat::stl;
  return result;
}

PointReadResult read_any(const MeshSource& source, const PointReadOptions& options) {
  if (begins_with_pcd(source.bytes)) return read_pcd_points(source, options);
  if (begins_with_ply(source.bytes)) return read_ply_points(source, options);
  if (is_point_text(source)) return read_xyz_points(source, options);
  if (looks_like_text(source.bytes) && has_point_extension(source.name)) {
    source.fail("is no list of points: it does not begin with lines of three numbers");
  }
  const SoupFormat format = recognize_mesh(source);
  if (format == SoupFormat::obj) return read_obj_points(source, options);
  return corners_of(read_mesh_as(format, source));
}

void judge(const MeshSource& source, const PointReadResult& result) {
  const std::size_t points = result.cloud.points.size();
  require_points(points, source.name);
  if (points > 0) return;
  const auto& warnings = result.report.warnings;
  source.fail("holds no readable points" +
              (warnings.empty() ? std::string() : " (" + warnings.front().text + ")"));
}

PointReadResult read_points_of(const OpenedFile& file, PointReadOptions options) {
  options.progress = file.source().options.progress;
  PointReadResult result = read_any(file.source(), options);
  judge(file.source(), result);
  file.describe(result.report);
  return result;
}

MeshOrPoints read_any_of(const OpenedFile& file) {
  const MeshSource& source = file.source();
  MeshOrPoints result;
  if (is_point_cloud(source)) {
    result.points = read_points_of(file, {});
    return result;
  }
  ReadResult mesh = read_mesh_as(recognize_mesh(source), source);
  if (is_without_faces(mesh)) {
    result.points = read_points_of(file, {});
    return result;
  }
  require_mesh(source, mesh);
  file.describe(mesh.report);
  mesh.report.names = file.names();
  result.mesh = std::move(mesh);
  return result;
}

ReadOptions asking(ProgressObserver* progress) {
  ReadOptions options;
  options.progress = progress;
  return options;
}

}  // namespace

std::string_view format_name(PointFormat format) {
  constexpr std::array<std::string_view, 10> kFormats = {
      "XYZ",       "PTS",        "ASCII PCD", "binary PCD", "compressed PCD",
      "ASCII PLY", "binary PLY", "OBJ",       "OFF",        "STL"};
  return kFormats[static_cast<std::size_t>(format)];
}

PointReadResult read_points(const std::filesystem::path& path, const PointReadOptions& options) {
  return read_points_of(OpenedFile(path, asking(options.progress)), options);
}

PointReadResult read_points(std::string_view bytes, const std::string& name,
                            const PointReadOptions& options) {
  return read_points_of(OpenedFile(bytes, name, asking(options.progress)), options);
}

std::string known_point_extensions() {
  std::string list;
  for (const std::string_view extension : kPointExtensions) list += std::string(extension) + ", ";
  return list + ".pcd";
}

MeshOrPoints read_mesh_or_points(const std::filesystem::path& path, const ReadOptions& options) {
  return read_any_of(OpenedFile(path, options));
}

MeshOrPoints read_mesh_or_points(std::string_view bytes, const std::string& name,
                                 const ReadOptions& options) {
  return read_any_of(OpenedFile(bytes, name, options));
}

}  // namespace meshrepair
