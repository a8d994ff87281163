// SPDX-License-Identifier: MIT
#include "steps/origin_steps.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <spdlog/fmt/fmt.h>

#include <base/error.h>
#include <mesh/far_coordinates.h>

#include "options/numbers.h"
#include "terminal/warning_log.h"

namespace meshrepair {
namespace {

void set_origin(const std::string& word, OriginOptions& options) {
  options.automatic = word == "auto";
  options.stays = word == "none";
  options.offset = vector_in(word);
}

std::vector<Vec3d>& points_of(AnySoup& input) {
  return input.cloud ? input.cloud->points : input.soup.points;
}

// Of neighbours. Points lie on a surface.
double spacing_of(const AnySoup& input) {
  if (!input.cloud) return typical_edge(input.soup);
  const auto count = static_cast<double>(input.cloud->points.size());
  return count > 0 ? single_precision_loss(input.cloud->points, 0).diagonal / std::sqrt(count) : 0;
}

// Where meshes have places, these move the other way.
void subtract(const Vec3d& offset, bool has_places, AnySoup& input) {
  move_points(points_of(input), -offset);
  if (!has_places) return;
  for (SceneInstance& instance : input.scene.instances) {
    instance.placement.offset += instance.placement.linear * offset;
  }
}

void warn_of_single_precision(const std::vector<Vec3d>& points, double spacing,
                              const Findings& findings) {
  const SinglePrecisionLoss loss = single_precision_loss(points, spacing);
  if (!loss.matters) return;
  warn(findings.input_name(),
       {WarningCode::float32_step,
        fmt::format("single precision (float32) has steps of {:.3g} at these coordinates: corners "
                    "move by up to {:.3g}, {:.2g} % of the size; --origin auto subtracts an offset",
                    loss.step, loss.move, 100 * loss.move / loss.diagonal),
        {{"step", loss.step}, {"move", loss.move}, {"diagonal", loss.diagonal}}});
}

std::optional<Vec3d> known_offset(const Findings& findings) {
  return findings.points_read ? findings.points_read->offset
         : findings.mesh_read ? findings.mesh_read->offset
                              : std::nullopt;
}

}  // namespace

void add_origin_options(CommandLine& app, OriginOptions& options) {
  const CommandOption* const origin =
      app.add_option_function(
             "--origin", [&options](const std::string& word) { set_origin(word, options); },
             "Subtract an offset from all coordinates, and keep it in OUT (glTF, 3MF, OBJ, OFF,\n"
             "PLY) and in the report:\n"
             "  auto   a round one, if single precision cannot hold the coordinates\n"
             "  X,Y,Z  this one\n"
             "  none   nothing, and do not warn")
          ->check([](const std::string& word) {
            if (word == "auto" || word == "none" || vector_in(word)) return std::string();
            return word + " is none of auto, none, and three numbers X,Y,Z";
          })
          ->type_name("WORD|X,Y,Z")
          ->default_str("warn")
          ->group("Output");
  app.add_flag("--restore-origin", options.restore,
               "Add the offset that IN names in a comment: \"# offset X Y Z\" in OBJ, OFF and\n"
               "lists of points, \"comment offset X Y Z\" in PLY")
      ->excludes(origin)
      ->group("Output");
}

namespace {

// Programs read these in single precision, or the format holds no other.
bool is_read_as_single(SoupFormat format, Precision precision) {
  return precision == Precision::float32 || is_single(format) || format == SoupFormat::threemf ||
         format == SoupFormat::stl_ascii;
}

bool is_gltf(SoupFormat format) { return format == SoupFormat::glb || format == SoupFormat::gltf; }

// What cannot be moved.
void check_movable(SoupFormat output, const AnySoup& input, const Findings& findings) {
  if (!findings.mesh_read || !has_instances(output)) return;
  const SoupFormat given = findings.mesh_read->format;
  if (!input.scene.meshes.empty() && (given == output || (is_gltf(given) && is_gltf(output)))) {
    throw UsageError("--origin: with --scene each, meshes stay where the scene of IN has them");
  }
  const auto& corners = input.attributes.corners;
  if (is_gltf(output) && std::any_of(corners.begin(), corners.end(), [](const auto& attribute) {
        return attribute.kind == CornerAttribute::Kind::skin;
      })) {
    throw UsageError("--origin: a mesh with a skin stands where its joints are; --drop others");
  }
}

}  // namespace

void move_origin_stage(const OriginOptions& options, SoupFormat output, Precision precision,
                       AnySoup& input, Findings& findings) {
  const bool has_places = has_instances(output) && !input.scene.meshes.empty();
  findings.origin = known_offset(findings);
  if (options.restore && findings.origin) {
    subtract(-*findings.origin, false, input);
    findings.origin.reset();
  } else if (options.restore &&
             !(findings.mesh_read && has_instances(findings.mesh_read->format))) {
    throw UsageError("--restore-origin: IN names no offset");
  }
  Vec3d offset = options.offset.value_or(Vec3d::Zero());
  if (options.automatic) offset = fitting_offset(points_of(input), spacing_of(input));
  if (offset != Vec3d::Zero()) {
    check_movable(output, input, findings);
    subtract(offset, has_places, input);
    findings.origin = findings.origin.value_or(Vec3d::Zero()) + offset;
    findings.is_origin_in_places = has_places;
  }
  if (is_read_as_single(output, precision) && !options.stays) {
    warn_of_single_precision(points_of(input), spacing_of(input), findings);
  }
}

void CommonOrigin::apply(std::optional<Vec3d> known, TriangleSoup& soup, const Findings& findings) {
  const Vec3d own = known.value_or(Vec3d::Zero());
  if (!std::exchange(is_known_, true)) {
    if (!options_.restore) origin_ = own;
    if (options_.offset) origin_ += *options_.offset;
    if (options_.automatic) origin_ += fitting_offset(soup.points, typical_edge(soup));
  }
  move_points(soup.points, own - origin_);
  if (output_ && is_read_as_single(*output_, Precision::float64) && !options_.stays) {
    warn_of_single_precision(soup.points, typical_edge(soup), findings);
  }
}

std::optional<Vec3d> CommonOrigin::get() const {
  return origin_ == Vec3d::Zero() ? std::nullopt : std::optional(origin_);
}

void keep_origin(const Findings& findings, WriteOptions& format) {
  if (!findings.origin || findings.is_origin_in_places) return;
  if (has_instances(*format.format)) {
    format.extras.origin = findings.origin;
  } else {
    format.extras.comments.push_back(offset_comment(*findings.origin));
  }
}

}  // namespace meshrepair
