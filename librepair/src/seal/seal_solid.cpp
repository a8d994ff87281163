// SPDX-License-Identifier: MIT
// From outside to inside:
//
// - Bodies that are far from each other are sealed one by one: bodies_apart.h, seal_body.h.
// - A grid of cubes is laid around the surface, or around its narrow places, and a ball rolls
//   through it: openings.h. That tells where openings are, as well as cubes can.
// - There the faces of the cubes are added to the surface, and all is cut exactly. Of the faces the
//   smallest are taken that part what is behind from what is before: closed_openings.h. That closes
//   what there is, whatever cubes have missed.

#include "seal_solid.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <base/error.h>
#include <base/roots.h>
#include <base/stage_meter.h>
#include <mesh/topology.h>
#include <repair/explain_repair.h>

#include "again/second_repair.h"
#include "bodies_apart.h"
#include "closed_openings.h"
#include "double_walls.h"
#include "openings.h"
#include "report/describe_result.h"

namespace meshrepair::internal {
namespace {

// How many pieces of each triangle of the soup a surface has, and whether they have only corners of
// it.
struct Pieces {
  std::vector<std::uint32_t> count;
  std::vector<char> is_whole;

  Pieces(std::size_t triangles, const Surface& surface)
      : count(triangles, 0), is_whole(triangles, 0) {
    for (std::size_t t = 0; t < surface.source.size(); ++t) {
      const std::uint32_t source = surface.source[t];
      if (source == Surface::kNoSource) continue;
      const auto& c = surface.mesh.triangles[t];
      const bool is_given = std::all_of(
          c.begin(), c.end(), [&](std::uint32_t p) { return surface.input_point[p] != 0; });
      is_whole[source] = count[source] == 0 && is_given ? 1 : 0;
      ++count[source];
    }
  }
};

void note_fates(std::size_t triangles, const Surface& before, const Surface& after,
                RepairReport& report) {
  const Pieces had(triangles, before), has(triangles, after);
  report.triangles = {};
  for (std::size_t t = 0; t < triangles; ++t) {
    if (has.count[t] > 0)
      ++(has.is_whole[t] != 0 ? report.triangles.untouched : report.triangles.cut);
    if (had.count[t] == 0 || has.count[t] > 0) continue;
    if (report.parts.bounding_triangles > 0) --report.parts.bounding_triangles;
    ++report.parts.inside_triangles;
  }
  report.parts.places.clear();
}

void explain_seals(const TriangleSoup& soup, const Surface& before, const Sealed& after,
                   RepairExplanation& explanation) {
  const std::size_t triangles = soup.triangles.size();
  const Pieces had(triangles, before), has(triangles, after.surface);
  for (std::size_t t = 0; t < triangles; ++t) {
    if (had.count[t] == 0 || explanation.fates[t] == TriangleFate::thickened) continue;
    if (has.count[t] == 0) {
      explanation.fates[t] = TriangleFate::inside;
    } else if (explanation.fates[t] == TriangleFate::whole && has.is_whole[t] == 0) {
      explanation.fates[t] = TriangleFate::cut;
    }
  }
  explanation.origins = find_origins(soup, explanation.fates, after.surface);
  for (std::size_t t = 0; t < after.is_patch.size(); ++t) {
    if (after.is_patch[t] != 0) explanation.origins[t] = TriangleOrigin::seal;
  }
}

void add_certify(const CertifyReport& more, CertifyReport& report) {
  report.done = report.done && more.done;
  report.pairs_at_first += more.pairs_at_first;
  report.pairs += more.pairs;
  report.degenerate += more.degenerate;
  report.rounds = std::max(report.rounds, more.rounds);
  report.snapped_points += more.snapped_points;
  report.dropped_parts += more.dropped_parts;
  report.dropped_share = std::max(report.dropped_share, more.dropped_share);
  report.joined_points += more.joined_points;
  report.inside_out_parts += more.inside_out_parts;
}

// With lengths in place of shares, as these are of the whole.
RepairOptions options_of_bodies(const TriangleSoup& mesh, const RepairOptions& options) {
  RepairOptions of_bodies = options;
  SealOptions& seal = of_bodies.seal;
  if (seal.is_share) seal.size *= 2 * stable_length(half_extent_of(mesh));
  seal.is_share = false;
  return of_bodies;
}

// One body as if it were the whole; several one by one, as parts of one stage.
class BodiesSealer {
 public:
  BodiesSealer(const Surface& solid, const RepairOptions& options, const RepairAgain& repair_again,
               RepairReport& report)
      : solid_(solid), options_(options), repair_again_(repair_again), report_(report) {
    // Faults cannot be counted body by body.
    const bool may_divide = !options.certify.wanted || report.certify.passed();
    if (may_divide) bodies_ = divide_surface(solid, bodies_of(solid.mesh));
  }

  std::optional<Sealed> run() {
    if (bodies_.size() < 2) return seal_whole();
    const RepairReport before = report_;
    StageMeter meter(report_.stages, options_.progress);
    meter.begin("seal");
    for (std::size_t b = 0; b < bodies_.size(); ++b) seal(b);
    if (sealed_ == 0) return std::nullopt;
    if (are_apart(boxes_)) return std::move(all_);
    meter.end();
    std::vector<StageReport> stages = std::move(report_.stages);
    report_ = before;
    report_.stages = std::move(stages);
    return seal_whole();
  }

 private:
  // A ball of the size passes between them, and patches of one do not come to another one; where
  // sizes are found, they hardly ever do.
  [[nodiscard]] MeshParts bodies_of(const TriangleSoup& mesh) const {
    const SealOptions& seal = options_.seal;
    return bodies_apart(mesh, 2 * (seal.automatic ? kLargestShareTried : seal.size),
                        seal.automatic);
  }

  std::optional<Sealed> seal_whole() {
    bodies_.clear();
    RepairReport second;
    std::optional<Sealed> sealed = seal_body(solid_, 1, options_, repair_again_, second);
    note(std::move(second), sealed.has_value());
    return sealed;
  }

  void seal(std::size_t b) {
    const auto count = static_cast<double>(bodies_.size()), at = static_cast<double>(b);
    ShareOfStage progress(options_.progress, at / count, (at + 1) / count);
    progress.advance(0);
    RepairOptions options = options_;
    options.progress = &progress;
    RepairReport second;
    std::optional<Sealed> sealed =
        seal_body(bodies_[b], bodies_.size(), options, repair_again_, second);
    second.stages.clear();
    note(std::move(second), sealed.has_value());
    sealed_ += sealed ? 1 : 0;
    if (!sealed) sealed = {std::move(bodies_[b]), {}};
    sealed->is_patch.resize(sealed->surface.source.size(), 0);
    append_surface(all_.surface, sealed->surface);
    all_.is_patch.insert(all_.is_patch.end(), sealed->is_patch.begin(), sealed->is_patch.end());
    boxes_.emplace_back();
    for (const Vec3d& p : sealed->surface.mesh.points) boxes_.back().add(p);
    bodies_[b] = {};
  }

  // What was certified of bodies that stay is so still.
  void note(RepairReport second, bool is_sealed) {
    add_seal(second.seal, report_.seal);
    if (!is_sealed) {
      report_.stages.insert(report_.stages.end(), second.stages.begin(), second.stages.end());
      return;
    }
    const CertifyReport certify = report_.certify;
    const double slits = report_.slits_area, fins = report_.fins_area;
    append_report(std::move(second), report_);
    if (bodies_.empty()) return;
    report_.slits_area += slits;
    report_.fins_area += fins;
    add_certify(certify, report_.certify);
  }

  const Surface& solid_;
  const RepairOptions options_;
  const RepairAgain& repair_again_;
  RepairReport& report_;
  std::vector<Surface> bodies_;
  std::vector<Box> boxes_;  // of those that are done
  Sealed all_;
  std::size_t sealed_ = 0;
};

}  // namespace

Surface seal_solid(const TriangleSoup& soup, Surface solid, const RepairOptions& options,
                   const RepairAgain& repair_again, RepairReport& report) {
  std::optional<Sealed> sealed =
      options.seal.double_walls
          ? fill_double_walls(solid, options, repair_again, report)
          : BodiesSealer(solid, options_of_bodies(solid.mesh, options), repair_again, report).run();
  report.seal.automatic = options.seal.automatic;
  if (!sealed) return solid;
  note_fates(soup.triangles.size(), solid, sealed->surface, report);
  if (options.explain) explain_seals(soup, solid, *sealed, report.explanation);
  describe_output(sealed->surface, report);
  return std::move(sealed->surface);
}

namespace {

Surface without(const Surface& solid, const std::vector<char>& dropped) {
  std::vector<char> keep;
  keep.reserve(dropped.size());
  for (const char is_dropped : dropped) keep.push_back(is_dropped == 0 ? 1 : 0);
  Surface rest = solid;
  keep_triangles(rest, keep);
  return rest;
}

bool spared_cells(const RepairReport& report) { return report.kept_valid || report.spared_cells; }

double area_of_patches(const Sealed& sealed) {
  TriangleSoup patches;
  patches.points = sealed.surface.mesh.points;
  for (std::size_t t = 0; t < sealed.is_patch.size(); ++t) {
    if (sealed.is_patch[t] != 0) patches.triangles.push_back(sealed.surface.mesh.triangles[t]);
  }
  return surface_area(patches);
}

// The rest, its pinholes closed; nothing if it is to be certified and is not.
std::optional<Sealed> closed(const Surface& rest, const RepairOptions& options,
                             const RepairAgain& repair_again, RepairReport& report) {
  const SecondSoup second(rest);
  RepairOptions again = options_for_second(second, options);
  again.holes = {};
  try {
    Sealed sealed{repair_again(second.soup, again, report), {}};
    if (options.certify.wanted && !report.certify.passed()) return std::nullopt;
    for (const std::uint32_t source : sealed.surface.source) {
      sealed.is_patch.push_back(source == Surface::kNoSource ? 1 : 0);
    }
    refer_to_first(second, sealed.surface);
    return sealed;
  } catch (const NoSolidError&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<Sealed> fill_double_walls(const Surface& solid, const RepairOptions& options,
                                        const RepairAgain& repair_again, RepairReport& report) {
  DoubleWalls walls;
  {
    StageMeter meter(report.stages, options.progress);
    meter.begin("seal");
    walls = find_double_walls(solid, options.progress);
  }
  if (walls.bodies == 0) return std::nullopt;
  report.seal.size = walls.widest;
  RepairReport second;
  std::optional<Sealed> sealed =
      closed(without(solid, walls.is_inner), options, repair_again, second);
  if (!sealed || signed_volume(sealed->surface.mesh) <= signed_volume(solid.mesh)) {
    report.stages.insert(report.stages.end(), second.stages.begin(), second.stages.end());
    report.seal.cannot_cut = walls.bodies;
    return std::nullopt;
  }
  report.seal.double_walls = walls.bodies;
  report.seal.openings = walls.pinholes;
  report.seal.patches_area = area_of_patches(*sealed);
  report.seal.filled_volume = signed_volume(sealed->surface.mesh) - signed_volume(solid.mesh);
  const bool spared_both = spared_cells(report) && spared_cells(second);
  append_report(std::move(second), report);
  report.spared_cells = spared_both;
  return sealed;
}

}  // namespace meshrepair::internal
