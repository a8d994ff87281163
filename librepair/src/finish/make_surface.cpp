#include "make_surface.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

#include <base/error.h>

#include "certify/drop_thin_parts.h"
#include "certify/settle_points.h"
#include "report/describe_result.h"
#include "sheets/fill_slits.h"

namespace meshrepair::internal {
namespace {

// As many as this may be chance.
constexpr std::size_t kFewFaults = 32;

// How much wider slits become from one attempt to the next, and in the last one.
constexpr double kWider = 4;
constexpr double kWidest = 16;

// Orientation is sound by now, and overlaps made by moving points are to be united.
Surface repair_again(const TriangleSoup& soup, const RepairOptions& options) {
  CancelOnly quiet(options.progress);
  RepairOptions again = options;
  again.inside.rule = InsideRule::winding;
  again.holes = {};
  again.opacity.clear();
  again.examine = nullptr;
  again.keep_valid = false;
  again.certify.wanted = false;
  // Points that are on the grid now, and coarser, say what they say.
  if (options.certify.precision == Precision::float64) again.slit_steps = 0;
  again.progress = &quiet;
  RepairReport report;
  return repair(soup, again, report);
}

Surface extract(const CoveredCells& covered, std::vector<char> solid, const RepairOptions& options,
                RepairReport& report) {
  report.extract = {};
  fill_slits(covered, options, {}, {}, solid, report);
  if (std::count(solid.begin(), solid.end(), 1) == 0) {
    throw NoSolidError("the triangles enclose nothing: open sheets, as thick as their rounding");
  }
  report.parts = find_part_fates(covered.complex.soup(),
                                 places_of_triangles(covered.complex, covered.cover, solid));
  ExtractOptions extract_options = options.extract;
  extract_options.progress = options.progress;
  return extract_surface(covered.complex, covered.cover, solid, report.extract, extract_options);
}

// Whatever is beyond would be written as infinity.
void require_range(const Surface& surface, Precision precision) {
  if (precision == Precision::float64) return;
  for (const Vec3d& p : surface.mesh.points) {
    if (p.cwiseAbs().maxCoeff() <= static_cast<double>(std::numeric_limits<float>::max())) continue;
    throw OutputError(
        "coordinates are too large for single precision: write OBJ, OFF or PLY in double "
        "precision");
  }
}

// What is thinner than a step of the grid says nothing about the input, whose points were put
// there. Returns which of the triangles left are whole.
std::vector<char> drop_crumbs(const CleanSoup& input, Surface& surface, RepairReport& report) {
  std::vector<char> whole = find_whole_triangles(input, surface);
  report.crumbs = drop_thin_crumbs(surface, whole, input.grid.unit);
  return report.crumbs > 0 ? find_whole_triangles(input, surface) : std::move(whole);
}

// What was never cut is to stay as it was.
std::vector<char> points_of(const Surface& surface, const std::vector<char>& whole) {
  std::vector<char> points(surface.mesh.points.size(), 0);
  for (std::size_t t = 0; t < whole.size(); ++t) {
    if (whole[t] == 0) continue;
    for (const std::uint32_t p : surface.mesh.triangles[t]) points[p] = 1;
  }
  return points;
}

std::optional<Surface> simplify(const Surface& surface, std::vector<char>& stays,
                                const RepairOptions& options, SimplifyReport& report) {
  Eigen::AlignedBox3d box;
  for (const Vec3d& p : surface.mesh.points) box.extend(p);
  SimplifyOptions simplify_options;
  simplify_options.within = options.simplify * (box.max() - box.min()).stableNorm();
  simplify_options.progress = options.progress;
  return simplify_cuts(surface, stays, simplify_options, report);
}

Surface certify(Surface surface, const Grid& grid, const RepairOptions& options,
                CertifyReport& report, std::function<Surface()> settle_again = {}) {
  CertifyOptions certify_options = options.certify;
  certify_options.touching = options.extract.touching;
  if (options.predicates != Predicates::exact) certify_options.most_rounds = 0;
  const CertifyHelp help{[&](const TriangleSoup& soup) { return repair_again(soup, options); },
                         std::move(settle_again)};
  return certify(std::move(surface), grid, certify_options, help, options.progress, report);
}

// `surface` is what became `simpler`; `stays`: points that were not simplified away.
Surface certify_simpler(const Surface& surface, Surface simpler, std::vector<char> stays,
                        const Grid& grid, const RepairOptions& options, RepairReport& report) {
  const auto settle_again = [&] {
    Surface settled = surface;
    settle_input_points(settled, grid, options.progress);
    const SimplifyReport before = report.simplify;
    std::optional<Surface> again = simplify(settled, stays, options, report.simplify);
    report.simplify.rounds += before.rounds;
    report.simplify.points_to_stay += before.points_to_stay;
    return again ? std::move(*again) : settled;
  };
  return certify(std::move(simpler), grid, options, report.certify, settle_again);
}

// Of cells that are labelled, the surface: the first one that is certified, else the one with the
// fewest faults.
class SurfaceMaker {
 public:
  SurfaceMaker(CoveredCells covered, const std::vector<char>& solid, const RepairOptions& options,
               RepairReport& report, StageMeter& meter)
      : covered_(std::move(covered)),
        input_(covered_->complex.soup()),
        solid_(solid),
        options_(options),
        report_(report),
        meter_(meter) {}

  Surface run() {
    meter_.begin("extract");
    const bool may_widen = widens_slits(*covered_, options_);
    Surface extracted = extract(*covered_, solid_, options_, report_);
    const bool may_leave = !may_widen && report_.thin_cells.filled + report_.thin_cells.emptied > 0;
    if (!options_.certify.wanted || !(may_widen || may_leave)) covered_.reset();
    const RepairReport at_first = report_;
    std::optional<Surface> with_all_triangles;
    if (options_.certify.wanted && options_.simplify > 0) with_all_triangles = extracted;
    surface_ = finish_surface(input_, std::move(extracted), options_, report_, meter_);
    if (covered_ && may_leave) leave_slits();
    // Many are left where the surface is finer than the numbers, and would be again.
    if (report_.certify.faults() > kFewFaults) return std::move(surface_);
    if (covered_ && may_widen) widen_slits();
    if (with_all_triangles) leave_all_triangles(std::move(*with_all_triangles), at_first);
    return std::move(surface_);
  }

 private:
  // Sheets that rounding makes cross may be gone with wider slits.
  void widen_slits() {
    ThinCellsReport last = report_.thin_cells;
    RepairOptions wider = options_;
    while (!report_.certify.passed() && wider.slit_steps < kWidest * options_.slit_steps) {
      wider.slit_steps *= kWider;
      meter_.begin("extract");
      RepairReport report = report_;
      Surface surface = extract(*covered_, solid_, wider, report);
      if (report.thin_cells.filled == last.filled && report.thin_cells.emptied == last.emptied) {
        continue;
      }
      last = report.thin_cells;
      attempt(std::move(surface), wider, std::move(report));
    }
  }

  // Where most is as thin as slits, what stays between those that go may have more faults.
  void leave_slits() {
    if (report_.certify.passed()) return;
    RepairOptions plain = options_;
    plain.slit_steps = 0;
    meter_.begin("extract");
    RepairReport report = report_;
    Surface surface = extract(*covered_, solid_, plain, report);
    attempt(std::move(surface), plain, std::move(report));
  }

  // The surface with all its triangles may have no faults.
  void leave_all_triangles(Surface extracted, const RepairReport& report) {
    if (report_.certify.passed()) return;
    RepairOptions plain = options_;
    plain.simplify = 0;
    plain.certify.most_rounds = std::min<std::size_t>(plain.certify.most_rounds, 1);
    attempt(std::move(extracted), plain, report);
  }

  void attempt(Surface surface, RepairOptions options, RepairReport report) {
    options.examine = nullptr;
    surface = finish_surface(input_, std::move(surface), options, report, meter_);
    if (report.certify.faults() >= report_.certify.faults()) return;
    report.stages = std::move(report_.stages);
    report_ = std::move(report);
    surface_ = std::move(surface);
  }

  std::optional<CoveredCells> covered_;  // gone as soon as nothing is to be extracted any more
  const CleanSoup& input_;
  const std::vector<char>& solid_;
  const RepairOptions& options_;
  RepairReport& report_;
  StageMeter& meter_;
  Surface surface_;
};

}  // namespace

Surface finish_surface(const CleanSoup& input, Surface surface, const RepairOptions& options,
                       RepairReport& report, StageMeter& meter) {
  require_range(surface, options.certify.precision);
  const std::vector<char> whole = drop_crumbs(input, surface, report);
  if (options.examine) {
    describe_result(input, surface, report);
    options.examine(report);
  }
  std::optional<Surface> simpler;
  std::vector<char> stays;
  report.simplify = {};
  if (options.simplify > 0) {
    meter.begin("simplify");
    stays = points_of(surface, whole);
    simpler = simplify(surface, stays, options, report.simplify);
  }
  if (options.certify.wanted) {
    meter.begin("certify");
    surface = simpler ? certify_simpler(surface, std::move(*simpler), std::move(stays), input.grid,
                                        options, report)
                      : certify(std::move(surface), input.grid, options, report.certify);
  } else if (simpler) {
    surface = std::move(*simpler);
  }
  meter.begin("check");
  describe_result(input, surface, report);
  return surface;
}

Surface make_surface(CoveredCells covered, const std::vector<char>& solid,
                     const RepairOptions& options, RepairReport& report, StageMeter& meter) {
  return SurfaceMaker(std::move(covered), solid, options, report, meter).run();
}

}  // namespace meshrepair::internal
