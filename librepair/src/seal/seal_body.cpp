// SPDX-License-Identifier: MIT
#include "seal_body.h"

#include <cmath>
#include <memory>
#include <utility>

#include <base/error.h>
#include <base/stage_meter.h>
#include <extract/simplify_cuts.h>
#include <mesh/internal/triangle_measures.h>
#include <mesh/topology.h>

#include "again/second_repair.h"
#include "arrange/chamber_surface.h"
#include "closed_openings.h"
#include "surface/make_surface.h"

namespace meshrepair::internal {
namespace {

class BodySealer {
 public:
  BodySealer(const Surface& body, std::size_t bodies, const RepairOptions& options,
             const RepairAgain& repair_again, RepairReport& report)
      : bodies_(bodies), options_(options), repair_again_(repair_again), report_(report) {
    now_ = {body, std::vector<char>(body.source.size(), 0)};
  }

  std::optional<Sealed> run() {
    bool is_sealed = false;
    while (close_next()) {
      is_sealed = true;
      if (!options_.seal.automatic) break;
    }
    if (!is_sealed) return std::nullopt;
    return std::move(now_);
  }

 private:
  bool close_next() {
    SealReport found;
    {
      StageMeter meter(report_.stages, options_.progress);
      meter.begin("seal");
      closed_ = close_openings(now_.surface, options_.seal, {bodies_, report_.seal.size}, found,
                               options_.progress);
    }
    if (!closed_) {
      add_seal(found, report_.seal);
      return false;
    }
    step_ = found.step;
    RepairReport second;
    second.stages = std::move(report_.stages);
    std::optional<Sealed> next = solid_of(second);
    if (!next) {
      report_.stages = std::move(second.stages);
      add_seal(as_it_was(found), report_.seal);
      return false;
    }
    measure_patches(*next, found);
    now_ = std::move(*next);
    add_seal(found, report_.seal);
    const SealReport seal = report_.seal;
    report_ = std::move(second);
    report_.seal = seal;
    return true;
  }

  // What was asked for, in vain.
  static SealReport as_it_was(const SealReport& found) {
    SealReport none;
    none.size = found.size;
    none.step = found.step;
    none.cannot_cut = 1;
    return none;
  }

  // Certified, where need be by repairing it once more. Nothing if what is solid then has no
  // boundary that can be told, in rare cases where walls nearly coincide.
  std::optional<Sealed> solid_of(RepairReport& report) const {
    RepairOptions second = options_for_second(closed_->second, options_);
    std::optional<Sealed> solid = extract(second, report);
    if (solid) return solid;
    second.certify.wanted = false;
    second.slit_steps = 0;
    second.simplify = 0;
    second.extract.may_touch_itself = true;
    forget(report);
    solid = extract(second, report);
    if (!solid) return std::nullopt;
    forget(report);
    try {
      return repaired(*solid, report);
    } catch (const NoSolidError&) {
      return std::nullopt;
    }
  }

  Sealed repaired(const Sealed& solid, RepairReport& report) const {
    const SecondSoup third(solid.surface);
    Surface surface = repair_again_(third.soup, options_for_second(third, options_), report);
    std::vector<char> is_patch;
    for (const std::uint32_t source : surface.source) {
      is_patch.push_back(source == Surface::kNoSource ? char{0} : solid.is_patch[source]);
    }
    refer_to_first(third, surface);
    return {std::move(surface), std::move(is_patch)};
  }

  // Nothing if it is to be certified and is not.
  std::optional<Sealed> extract(const RepairOptions& options, RepairReport& report) const {
    StageMeter meter(report.stages, options.progress);
    meter.begin("extract");
    std::optional<Surface> surface = boundary_of_chambers(closed_->soup, *closed_->arrangement,
                                                          closed_->filled.solid, options, report);
    if (!surface) return std::nullopt;
    if (options.certify.wanted) flatten_patches(*surface, options);
    surface = finish_surface(closed_->soup, std::move(*surface), options, report, meter);
    if (options.certify.wanted && !report.certify.passed()) return std::nullopt;
    std::vector<char> is_patch = patches_of(*surface);
    refer_to_first(closed_->second, *surface);
    return Sealed{std::move(*surface), std::move(is_patch)};
  }

  // Faces of cubes make stairs: points of patches alone may move as far as the grid is fine.
  void flatten_patches(Surface& surface, const RepairOptions& options) const {
    const std::vector<char> is_patch = patches_of(surface);
    std::vector<char> stays(surface.mesh.points.size(), 0);
    for (std::size_t t = 0; t < is_patch.size(); ++t) {
      if (is_patch[t] != 0) continue;
      for (const std::uint32_t p : surface.mesh.triangles[t]) stays[p] = 1;
    }
    SimplifyReport flattened;
    std::optional<Surface> flat = simplify_cuts(
        surface, stays, {.within = step_, .reach = {}, .progress = options.progress}, flattened);
    if (flat) surface = std::move(*flat);
  }

  // As flat as they are then. Keeps what is known where volumes are no numbers.
  void measure_patches(const Sealed& next, SealReport& found) const {
    const double filled = signed_volume(next.surface.mesh) - signed_volume(now_.surface.mesh);
    if (!std::isfinite(filled)) return;
    found.filled_volume = filled;
    found.patches_area = patches_area(next) - patches_area(now_);
  }

  static double patches_area(const Sealed& sealed) {
    const TriangleSoup& mesh = sealed.surface.mesh;
    double area = 0;
    for (std::size_t t = 0; t < sealed.is_patch.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      if (sealed.is_patch[t] == 0) continue;
      area += triangle_area(mesh.points[a], mesh.points[b], mesh.points[c]);
    }
    return area;
  }

  // Pre: the surface refers to the second soup, which begins with the body as it was.
  [[nodiscard]] std::vector<char> patches_of(const Surface& surface) const {
    std::vector<char> is_patch;
    for (const std::uint32_t source : surface.source) {
      const bool is_new = source >= closed_->second.first_added;
      is_patch.push_back(source == Surface::kNoSource ? char{0}
                         : is_new                     ? char{1}
                                                      : now_.is_patch[source]);
    }
    return is_patch;
  }

  // Stages took what they took.
  static void forget(RepairReport& report) {
    std::vector<StageReport> stages = std::move(report.stages);
    report = {};
    report.stages = std::move(stages);
  }

  std::size_t bodies_;
  const RepairOptions& options_;
  const RepairAgain& repair_again_;
  RepairReport& report_;
  Sealed now_;
  double step_ = 0;  // of the grid with which openings were closed
  std::unique_ptr<ClosedOpenings> closed_;
};

}  // namespace

std::optional<Sealed> seal_body(const Surface& body, std::size_t bodies,
                                const RepairOptions& options, const RepairAgain& repair_again,
                                RepairReport& report) {
  return BodySealer(body, bodies, options, repair_again, report).run();
}

}  // namespace meshrepair::internal
