// SPDX-License-Identifier: MIT
#include "fewer_triangles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <base/error.h>
#include <base/ids.h>
#include <check/check_surface.h>
#include <check/mesh_distance.h>
#include <repair/explain_repair.h>
#include <repair/transfer_attributes.h>
#include <repair/valid_solid.h>

#include "appearance.h"
#include "attributes/facing_sources.h"
#include "report/describe_result.h"
#include "seams.h"
#include "valid/keep_valid.h"

namespace meshrepair::internal {
namespace {

std::size_t asked_of(const FewerTrianglesOptions& fewer, std::size_t triangles) {
  if (fewer.most > 0 || fewer.share == 0) return fewer.most;
  constexpr long long kFewest = 4;  // a tetrahedron has so many
  return static_cast<std::size_t>(
      std::max(kFewest, std::llround(fewer.share * static_cast<double>(triangles))));
}

// A point that something was collapsed into, and moved, is none of the input.
Surface collapsed(const Surface& before, DecimatedMesh fewer) {
  Surface surface;
  surface.mesh = std::move(fewer.mesh);
  for (const std::uint32_t t : fewer.source) surface.source.push_back(before.source[t]);
  surface.input_point.assign(surface.mesh.points.size(), 0);
  for (std::size_t p = 0; p < fewer.point.size(); ++p) {
    const std::uint32_t now = fewer.point[p];
    if (before.input_point[p] != 0 && before.mesh.points[p] == surface.mesh.points[now]) {
      surface.input_point[now] = 1;
    }
  }
  return surface;
}

// Of each corner, where the input has its value.
std::vector<CornerOrigin> origins_of(const TriangleSoup& input, const Surface& before,
                                     const std::vector<CornerPlace>& corners) {
  const std::vector<std::uint32_t> sources = facing_sources(input, before);
  const auto normal_of = [](const TriangleSoup& soup, std::uint32_t t) {
    const auto& [a, b, c] = soup.triangles[t];
    return Vec3d((soup.points[b] - soup.points[a]).cross(soup.points[c] - soup.points[a]));
  };
  std::vector<CornerOrigin> origins;
  origins.reserve(corners.size());
  for (const CornerPlace& corner : corners) {
    CornerOrigin& origin = origins.emplace_back();
    origin.source = sources[corner.triangle];
    origin.place = corner.place;
    if (origin.source == Surface::kNoSource) continue;
    origin.turned =
        normal_of(input, origin.source).dot(normal_of(before.mesh, corner.triangle)) < 0;
  }
  return origins;
}

void keep_origins(const std::vector<std::uint32_t>& source, RepairExplanation& explanation) {
  if (explanation.origins.empty()) return;
  std::vector<TriangleOrigin> origins;
  origins.reserve(source.size());
  for (const std::uint32_t t : source) origins.push_back(explanation.origins[t]);
  explanation.origins = std::move(origins);
}

// Rounding turns triangles about an edge along which solids touch, so that some of these are joined
// there and others not: that is none of the faults.
bool is_solid(const TriangleSoup& mesh, const RepairOptions& options) {
  CancelOnly quiet(options.progress);
  if (valid_solid(mesh, written_as(options), &quiet)) return true;
  CheckOptions check;
  check.weld = options.certify.welded;
  check.progress = &quiet;
  return check_surface(mesh, check).valid_solid();
}

using Stay = DecimationOptions::Stay;

// Corners of the triangles stay.
void hold(const TriangleSoup& mesh, const std::vector<std::uint32_t>& triangles,
          std::vector<Stay>& stays) {
  for (const std::uint32_t t : triangles) {
    for (const std::uint32_t p : mesh.triangles[t]) stays[p] = std::max(stays[p], Stay::yes);
  }
}

// As few as are asked for, no farther from the surface than that. Collapses promise it of points,
// and it is proven of all between them: where that fails, points stay in the next try, and in later
// ones the others are held nearer, too. Without a collapse where nothing is proven.
DecimatedMesh decimate_within(double most, const TriangleSoup& mesh, DecimationOptions options,
                              FewerTrianglesReport& told) {
  constexpr double kOfPoints = 0.9;  // leaves something for what lies between
  constexpr int kMostReductions = 10, kAsFar = 4;
  CancelOnly quiet(options.progress);
  std::vector<Stay> stays(options.stays.begin(), options.stays.end());
  stays.resize(mesh.points.size(), Stay::no);
  options.distance = kOfPoints * most;
  options.find_corners = true;
  options.stays = stays;
  for (int i = 0; i < kMostReductions; ++i) {
    DecimatedMesh fewer = decimate(mesh, options, told.collapses);
    if (told.collapses.collapses == 0) return fewer;
    std::vector<std::uint32_t> far = triangles_beyond(mesh, fewer.mesh, most, &quiet);
    const std::vector<std::uint32_t> far_of_fewer =
        triangles_beyond(fewer.mesh, mesh, most, &quiet);
    if (far.empty() && far_of_fewer.empty()) return fewer;
    for (const std::uint32_t t : far_of_fewer) {
      far.push_back(fewer.source[t]);
      for (std::size_t k = 0; k < 3; ++k) far.push_back(fewer.corners[3 * t + k].triangle);
    }
    hold(mesh, far, stays);
    if (i >= kAsFar) options.distance /= 2;
  }
  told.collapses.collapses = 0;
  told.is_unproven = true;
  return {};
}

}  // namespace

void take_triangles_away(const TriangleSoup& input, Surface& surface, const RepairOptions& options,
                         RepairReport& report) {
  FewerTrianglesReport& told = report.fewer;
  told.before = told.after = surface.mesh.triangles.size();
  told.asked = asked_of(options.fewer, told.before);
  told.volume_before = told.volume_after = report.output_volume;
  if (!report.certify.passed()) return;
  StageMeter meter(report.stages, options.progress);
  meter.begin("fewer");
  DecimationOptions decimation;
  decimation.triangles = told.asked;
  decimation.precision = options.certify.precision;
  Seams seams;
  Appearance appearance;
  if (const Attributes* const given = options.fewer.attributes; given != nullptr) {
    const bool has_walls = report.thicken.triangles > 0;
    const Attributes carried = transfer_attributes(input, *given, surface, has_walls);
    seams = find_seams(surface, carried);
    appearance = appearance_of(surface, carried);
    decimation.find_corners = !given->corners.empty();
  }
  decimation.seams = seams.sides;
  decimation.stays = seams.stays;
  decimation.values = appearance.values;
  decimation.values_of_corner = appearance.of_corner;
  decimation.progress = options.progress;
  const FewerTrianglesOptions& asked = options.fewer;
  if (asked.distance > 0) {
    told.most_distance =
        asked.distance * (asked.distance_is_share ? bounding_diagonal(surface.mesh) : 1);
  }
  DecimatedMesh fewer = asked.distance > 0
                            ? decimate_within(told.most_distance, surface.mesh, decimation, told)
                            : decimate(surface.mesh, decimation, told.collapses);
  told.done = true;
  if (told.collapses.collapses == 0) return;
  if (!is_solid(fewer.mesh, options)) {
    throw InternalError("with fewer triangles the surface is no boundary of a solid any more");
  }
  keep_origins(fewer.source, report.explanation);
  if (decimation.find_corners) told.corners = origins_of(input, surface, fewer.corners);
  surface = collapsed(surface, std::move(fewer));
  report.spared_cells |= std::exchange(report.kept_valid, false);
  describe_output(surface, report);
  told.after = surface.mesh.triangles.size();
  told.volume_after = report.output_volume;
  TriangleFates& fates = report.triangles;
  fates = {};
  for (const auto& t : surface.mesh.triangles) {
    const bool is_given = std::all_of(t.begin(), t.end(),
                                      [&](std::uint32_t p) { return surface.input_point[p] != 0; });
    ++(is_given ? fates.untouched : fates.cut);
  }
}

}  // namespace meshrepair::internal
