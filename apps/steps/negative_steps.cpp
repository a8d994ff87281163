// SPDX-License-Identifier: MIT
#include "steps/negative_steps.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <base/error.h>
#include <base/stage_meter.h>
#include <boolean/boolean.h>
#include <mesh/append_soup.h>
#include <mesh/mesh_source.h>
#include <repair/transfer_attributes.h>

#include "terminal/warning_log.h"

namespace meshrepair {
namespace {

// Of one copy of an object.
struct VolumesOfObject {
  std::vector<PlacedVolume> filled, negative;
};

class NegativeVolumeSubtractor {
 public:
  NegativeVolumeSubtractor(const AnySoup& input, RepairOptions options, Findings& findings)
      : input_(input), options_(std::move(options)), findings_(findings) {
    keep_attributes(input.soup, input.attributes, options_);
    reach_ = std::exchange(options_.reach, {});
    options_.certify = {};
    options_.join_gaps = {};  // of all objects together
    options_.keep = {};       // of what is left in the end
    options_.fewer = {};
    options_.states = nullptr;
    options_.explain = false;
    options_.examine = nullptr;
  }

  // All objects in the order in which they were read, without negative volumes; sources are
  // triangles of the input.
  Surface run() {
    std::map<std::uint32_t, VolumesOfObject> objects;
    for (const PlacedVolume& placed : input_.placed) {
      VolumesOfObject& object = objects[placed.object];
      (volume_of(placed).fate == VolumeFate::subtracted ? object.negative : object.filled)
          .push_back(placed);
    }
    for (const auto& [number, object] : objects) {
      const auto difference =
          object.negative.empty() || object.filled.empty() ? std::nullopt : difference_of(object);
      if (difference) {
        append_surface(all_, *difference);
      } else {
        append_surface(all_, raw(object.filled));
      }
    }
    return std::move(all_);
  }

 private:
  ModelVolume& volume_of(const PlacedVolume& placed) {
    return findings_.mesh_read->volumes[placed.volume];
  }

  // The triangles as they are.
  [[nodiscard]] Surface raw(const std::vector<PlacedVolume>& volumes) const {
    Surface surface;
    for (const PlacedVolume& volume : volumes) append_raw(volume, surface);
    surface.input_point.assign(surface.mesh.points.size(), 1);
    return surface;
  }

  // The points of a volume follow each other, as its triangles do.
  void append_raw(const PlacedVolume& volume, Surface& surface) const {
    if (volume.triangles == 0) return;
    std::uint32_t first = Surface::kNoSource, last = 0;
    const auto& triangles = input_.soup.triangles;
    for (std::size_t t = volume.first; t < volume.first + volume.triangles; ++t) {
      const auto [least, most] = std::minmax_element(triangles[t].begin(), triangles[t].end());
      first = std::min(first, *least);
      last = std::max(last, *most);
    }
    TriangleSoup soup;
    const Vec3d* const point = input_.soup.points.data();
    soup.points.assign(point + first, point + last + 1);
    for (std::size_t t = volume.first; t < volume.first + volume.triangles; ++t) {
      auto corners = triangles[t];
      for (std::uint32_t& corner : corners) corner -= first;
      soup.triangles.push_back(corners);
      surface.source.push_back(static_cast<std::uint32_t>(t));
    }
    append_soup(surface.mesh, soup);
  }

  // Nothing where nothing can be subtracted.
  std::optional<Surface> difference_of(const VolumesOfObject& object) {
    const auto base = solid_of(object.filled, ": nothing is subtracted");
    std::vector<Surface> operands;
    std::vector<PlacedVolume> used;
    for (const PlacedVolume& negative : object.negative) {
      auto solid = base ? solid_of({negative}, " is not subtracted") : std::nullopt;
      if (!solid) {
        volume_of(negative).fate = VolumeFate::left_out;
        continue;
      }
      if (operands.empty()) operands.push_back(*base);
      operands.push_back(std::move(*solid));
    }
    if (operands.empty()) return std::nullopt;
    std::vector<TriangleSoup> solids;
    std::vector<std::uint32_t> source;
    for (Surface& operand : operands) {
      solids.push_back(std::move(operand.mesh));
      source.insert(source.end(), operand.source.begin(), operand.source.end());
    }
    BooleanOptions options;
    options.repair = options_;
    BooleanReport report;
    Surface difference = boolean(solids, SetOperation::subtract, options, report);
    compose(difference.source, source);
    if (difference.mesh.triangles.empty()) {
      warn(findings_.input_name(),
           {WarningCode::not_subtracted, "nothing is left of " + words_of(object.filled.front()) +
                                             " once its negative volumes are subtracted"});
    }
    return difference;
  }

  // As repair() makes it; sources are triangles of the input. Nothing, and a warning, where they
  // enclose nothing.
  std::optional<Surface> solid_of(const std::vector<PlacedVolume>& volumes, const char* what) {
    Surface given = raw(volumes);
    RepairOptions options = options_;
    if (!reach_.empty()) {
      for (const std::uint32_t t : given.source) options.reach.push_back(reach_[t]);
    }
    try {
      RepairReport report;
      Surface solid = repair(given.mesh, options, report);
      compose(solid.source, given.source);
      return solid;
    } catch (const NoSolidError&) {
      warn(findings_.input_name(), {WarningCode::not_subtracted,
                                    words_of(volumes.front()) + what + ": it encloses nothing"});
      return std::nullopt;
    }
  }

  static void compose(std::vector<std::uint32_t>& sources,
                      const std::vector<std::uint32_t>& before) {
    for (std::uint32_t& t : sources) {
      if (t != Surface::kNoSource) t = before[t];
    }
  }

  // For people: a negative volume, or the object.
  std::string words_of(const PlacedVolume& placed) {
    const ModelVolume& volume = volume_of(placed);
    if (volume.role == VolumeRole::negative) return volume_words(volume);
    return volume.object.empty() ? "an object" : "the object " + printable(volume.object);
  }

  const AnySoup& input_;
  RepairOptions options_;
  Findings& findings_;
  std::vector<double> reach_;  // of the triangles of the input
  Surface all_;
};

}  // namespace

std::vector<std::uint32_t> subtract_negatives_stage(AnySoup& input, const RepairOptions& options,
                                                    Run& run, Findings& findings) {
  if (input.placed.empty()) return {};
  StageMeter meter(findings.repair.stages, &run.progress);
  meter.begin("negative");
  Surface all = NegativeVolumeSubtractor(input, options, findings).run();
  if (all.mesh.triangles.empty()) {
    throw NoSolidError("nothing is left once its negative volumes are subtracted");
  }
  if (!input.attributes.is_bare()) {
    input.attributes = transfer_attributes(input.soup, input.attributes, all);
  }
  input.soup = std::move(all.mesh);
  input.placed.clear();
  return std::move(all.source);
}

}  // namespace meshrepair
