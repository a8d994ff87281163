// SPDX-License-Identifier: MIT
// From the surface of the best attempt to one that passes the test, or comes as near to it as was
// found. From the cheapest means to the dearest; each begins where the one before has left faults:
//
// 1. Points of the input come to lie where everything was decided, on the working grid, and what
//    was cut is simplified anew.
// 2. Place by place, points are moved and edges collapsed or flipped (mend_faults.h).
// 3. What is left is divided into groups of parts that lie near each other. Each is repaired again
//    by itself: as it is where few places are at fault, then with its points on a grid.
// 4. The same for the whole, round by round on coarser grids, if need be by cells.
//
// Every result is tested again as it will be written, and the one with the fewest faults is kept:
// no step can make it worse.
#include "certify_surface.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <base/error.h>
#include <base/progress.h>
#include <base/stage_meter.h>

#include "certify/certification.h"
#include "make_surface.h"
#include "prepare/prepare.h"

namespace meshrepair::internal {
namespace {

CertifyOptions certify_options(const RepairOptions& options) {
  CertifyOptions certify = options.certify;
  certify.touching = options.extract.touching;
  if (options.predicates != Predicates::exact) certify.most_rounds = 0;
  return certify;
}

// Orientation is sound by now, and overlaps made by moving points are to be united.
RepairOptions options_of_again(const RepairOptions& options, ProgressObserver& quiet) {
  RepairOptions again = options;
  again.inside.rule = InsideRule::winding;
  again.sew.mode = SewMode::none;
  again.holes = {};
  again.opacity.clear();
  again.examine = nullptr;
  again.certify.wanted = false;
  again.states = nullptr;
  // Points that are on the grid now, and coarser, say what they say.
  if (options.certify.precision == Precision::float64) again.slit_steps = 0;
  again.progress = &quiet;
  return again;
}

// Of the triangles of the surface, which are the input from now on.
std::vector<double> reach_of_triangles(const Surface& surface, const std::vector<double>& reach) {
  std::vector<double> of_triangle;
  if (reach.empty()) return of_triangle;
  of_triangle.reserve(surface.source.size());
  for (const std::uint32_t source : surface.source) {
    of_triangle.push_back(source == Surface::kNoSource ? std::numeric_limits<double>::infinity()
                                                       : reach[source]);
  }
  return of_triangle;
}

// A surface that is a solid already but for places where its sheets cross.
class RepairAgain {
 public:
  RepairAgain(const Surface& surface, const RepairOptions& options)
      : quiet_(options.progress),
        options_(options_of_again(options, quiet_)),
        meter_(report_.stages, &quiet_) {
    options_.reach = reach_of_triangles(surface, options.reach);
    clean_ = close_surface(surface.mesh, options_, report_, meter_);
    orientation_ = orient_soup(clean_, options_, report_, meter_);
  }

  // Not where slits are to be filled, as mostly in single precision: rounding would make sheets
  // cross again and again.
  std::optional<Surface> by_chambers() {
    SavedStates none;
    if (options_.all_cells || options_.slit_steps > 0) return std::nullopt;
    return surface_by_chambers(clean_, orientation_, options_, none, report_, meter_);
  }

  // To be called last.
  Surface by_cells() {
    return surface_by_cells(std::move(clean_), orientation_, options_, report_, meter_);
  }

 private:
  CancelOnly quiet_;
  RepairOptions options_;
  RepairReport report_;
  StageMeter meter_;
  CleanSoup clean_;
  Orientation orientation_;
};

Surface repair_again(const Surface& surface, const RepairOptions& options) {
  RepairAgain again(surface, options);
  if (auto mended = again.by_chambers()) return std::move(*mended);
  return again.by_cells();
}

// Where they cross in a few places only, slits may stay, and all points where they are.
std::optional<Surface> repair_places(const Surface& surface, RepairOptions options) {
  options.slit_steps = 0;
  try {
    return RepairAgain(surface, options).by_chambers();
  } catch (const NoSolidError&) {
    return std::nullopt;
  }
}

// With its input points where everything was decided, and simplified anew.
void settle_and_simplify(const Surface& original, Simplifier& simplifier,
                         Certification& certification) {
  Surface settled = certification.settled(original);
  std::optional<Surface> again = simplifier.simplified(settled);
  certification.start_again(again ? std::move(*again) : std::move(settled));
}

// What mending in place has left.
void repair_few_places(Certification& certification, const RepairOptions& options) {
  if (options.all_cells) return;
  for (;;) {
    const bool as_they_are = certification.are_few_places();
    if (!as_they_are && !certification.may_snap_places()) return;
    std::optional<Surface> again =
        as_they_are ? repair_places(certification.begin_places(), options)
                    : repair_places(certification.begin_snapped_places(), options);
    if (again) certification.end_places(std::move(*again));
  }
}

void repair_in_rounds(Certification& certification, const RepairOptions& options) {
  while (certification.may_go_on()) {
    const Surface& coarser = certification.begin_round();
    try {
      certification.end_round(repair_again(coarser, options));
    } catch (const NoSolidError&) {
      break;  // the coarser grid leaves nothing
    }
  }
}

// One bad place costs no more than its group.
void repair_groups(Certification& whole, const Grid& grid, const CertifyOptions& certify,
                   const RepairOptions& options) {
  std::vector<Surface> groups = whole.take_faulty_groups();
  if (groups.empty()) return;
  std::size_t triangles = 0;
  for (const Surface& group : groups) triangles += group.mesh.triangles.size();
  double from = 0;
  for (Surface& group : groups) {
    const double to =
        from + static_cast<double>(group.mesh.triangles.size()) / static_cast<double>(triangles);
    ShareOfStage part(whole.groups_progress(), from, to);
    from = to;
    CertifyReport report;
    Certification one(std::move(group), grid, certify, &part, report);
    repair_few_places(one, options);
    if (one.may_go_on()) one.mend_in_place();
    repair_in_rounds(one, options);
    whole.give_back(one);
  }
  whole.end_groups();
}

}  // namespace

Surface certify_surface(Surface surface, std::optional<Surface> simpler, Simplifier& simplifier,
                        const Grid& grid, const RepairOptions& options, CertifyReport& report) {
  const CertifyOptions certify = certify_options(options);
  std::optional<Surface> original = std::move(simpler);
  if (original) std::swap(surface, *original);
  Certification certification(std::move(surface), grid, certify, options.progress, report);
  if (certification.may_settle()) {
    certification.settle();
    // Points that are gone by then may be what the others were decided with.
    if (original && certification.may_settle()) {
      certification.mend_in_place();
      if (certification.may_settle()) settle_and_simplify(*original, simplifier, certification);
    }
  }
  certification.mend_in_place();
  repair_groups(certification, grid, certify, options);
  repair_few_places(certification, options);
  repair_in_rounds(certification, options);
  return certification.result();
}

}  // namespace meshrepair::internal
