// SPDX-License-Identifier: MIT
// Where sheets are nearer to each other than numbers tell, a surface may not be certified at once.
// Then it is made again in other ways, which are listed, and the one with the fewest faults is
// taken.
#include "make_surface.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <base/error.h>
#include <extract/extract_surface.h>

#include "arrange/chamber_surface.h"
#include "slits/fill_slits.h"
#include "solid/find_solid.h"

namespace meshrepair::internal {
namespace {

// One way to make the surface from its cells. What it leaves out is as the options say.
struct Attempt {
  // As many times as wide as asked for are the slits that are filled; 0: none are.
  double slits = 1;
  bool simplified = true;
  // Rounds of certification at most.
  std::size_t most_rounds = ~std::size_t{0};
  // Of more faults than may be chance, too: many are left where the surface is finer than the
  // numbers, and would be again.
  bool of_many_faults = false;

  [[nodiscard]] bool is_first() const { return slits == 1 && simplified; }
};

constexpr std::size_t kFewFaults = 32;

// What moving points does not mend soon is left to a repair that may cut otherwise; and so are more
// pairs of triangles that rounding makes meet than may be chance.
constexpr std::size_t kRoundsBeforeCells = 1;

// In this order, until one is certified.
constexpr std::array<Attempt, 5> kAttempts = {{
    {.of_many_faults = true},
    // Where most is as thin as slits, what stays between those that go may have more faults.
    {.slits = 0, .of_many_faults = true},
    // Sheets that rounding makes cross may be gone with wider slits.
    {.slits = 4},
    {.slits = 16},
    // The surface with all its triangles may have no faults.
    {.simplified = false, .most_rounds = 1},
}};

Surface extract(const CoveredCells& covered, std::vector<char> solid, const RepairOptions& options,
                RepairReport& report) {
  report.extract = {};
  fill_slits(covered, options, solid, report);
  if (std::count(solid.begin(), solid.end(), 1) == 0) {
    throw NoSolidError("the triangles enclose nothing: open sheets, as thick as their rounding");
  }
  report.parts = find_part_fates(covered.complex.soup(),
                                 places_of_triangles(covered.complex, covered.cover, solid));
  ExtractOptions extract_options = options.extract;
  extract_options.progress = options.progress;
  return extract_surface(covered.complex, covered.cover, solid, report.extract, extract_options);
}

class SurfaceMaker {
 public:
  SurfaceMaker(CoveredCells covered, const std::vector<char>& solid, const RepairOptions& options,
               RepairReport& report, StageMeter& meter)
      : covered_(std::move(covered)),
        may_widen_(widens_slits(*covered_, options)),
        input_(covered_->complex.soup()),
        solid_(solid),
        options_(options),
        report_(report),
        meter_(meter) {}

  Surface run() {
    for (const Attempt& attempt : kAttempts) {
      if (is_worth_it(attempt)) make(attempt);
    }
    return std::move(surface_);
  }

 private:
  [[nodiscard]] bool is_worth_it(const Attempt& attempt) const {
    if (attempt.is_first()) return true;
    if (!options_.certify.wanted || report_.certify.passed()) return false;
    if (!attempt.of_many_faults && report_.certify.faults() > kFewFaults) return false;
    if (!attempt.simplified) return options_.simplify > 0;
    return attempt.slits == 0 ? may_leave_ : may_widen_;
  }

  void make(const Attempt& attempt) {
    RepairOptions options = options_;
    options.slit_steps *= attempt.slits;
    if (!attempt.simplified) options.simplify = 0;
    options.certify.most_rounds = std::min(options.certify.most_rounds, attempt.most_rounds);
    if (attempt.is_first()) return make_first(options);
    options.examine = nullptr;
    if (!attempt.simplified) return take_if_better(std::move(extracted_), options, at_first_);
    meter_.begin("extract");
    RepairReport report = report_;
    Surface surface = extract(*covered_, solid_, options, report);
    const bool same = report.thin_cells.filled == last_slits_.filled &&
                      report.thin_cells.emptied == last_slits_.emptied;
    if (same) return;
    last_slits_ = report.thin_cells;
    take_if_better(std::move(surface), options, std::move(report));
  }

  // What later attempts need is kept, and nothing else.
  void make_first(const RepairOptions& options) {
    meter_.begin("extract");
    Surface surface = extract(*covered_, solid_, options, report_);
    last_slits_ = report_.thin_cells;
    may_leave_ = !may_widen_ && last_slits_.filled + last_slits_.emptied > 0;
    if (!options.certify.wanted || !(may_widen_ || may_leave_)) covered_.reset();
    at_first_ = report_;
    if (options.certify.wanted && options.simplify > 0) extracted_ = surface;
    surface_ = finish_surface(input_, std::move(surface), options, report_, meter_);
  }

  void take_if_better(Surface surface, const RepairOptions& options, RepairReport report) {
    surface = finish_surface(input_, std::move(surface), options, report, meter_);
    if (report.certify.faults() >= report_.certify.faults()) return;
    report.stages = std::move(report_.stages);
    report_ = std::move(report);
    surface_ = std::move(surface);
  }

  std::optional<CoveredCells> covered_;  // gone as soon as nothing is to be extracted any more
  const bool may_widen_;
  const CleanSoup& input_;
  const std::vector<char>& solid_;
  const RepairOptions& options_;
  RepairReport& report_;
  StageMeter& meter_;

  bool may_leave_ = false;      // slits were filled, and may stay instead
  ThinCellsReport last_slits_;  // of the last surface that was extracted
  Surface extracted_;           // the first one, with all its triangles, where it may be needed
  RepairReport at_first_;       // of it
  Surface surface_;             // the best so far
};

}  // namespace

Surface make_surface(CoveredCells covered, const std::vector<char>& solid,
                     const RepairOptions& options, RepairReport& report, StageMeter& meter) {
  return SurfaceMaker(std::move(covered), solid, options, report, meter).run();
}

Surface surface_by_cells(CleanSoup soup, const Orientation& orientation,
                         const RepairOptions& options, RepairReport& report, StageMeter& meter) {
  Tree tree = divide_space(std::move(soup), options, report, meter);
  CoveredCells covered = make_cells(tree, orientation.winding, options, report, meter);
  // From here on only the input is needed, not the partition.
  tree.nodes = {};
  tree.node_triangles = {};
  tree.leaves = {};
  const CellLabels labels = find_solid(covered, orientation, options, report, meter);
  return make_surface(std::move(covered), labels.solid, options, report, meter);
}

std::optional<Surface> surface_by_chambers(const CleanSoup& soup, const Orientation& orientation,
                                           const RepairOptions& options, SavedStates& states,
                                           RepairReport& report, StageMeter& meter) {
  RepairReport attempt = report;
  std::optional<Surface> surface =
      made_once(states, kChambersState, attempt, report.stages, meter,
                [&] { return surface_of_chambers(soup, orientation, options, attempt, meter); });
  if (!surface) return std::nullopt;
  RepairOptions finishing = options;
  finishing.examine = nullptr;
  // In single precision cells fill slits.
  if (options.certify.precision == Precision::float32) {
    finishing.certify.most_rounds = std::min(finishing.certify.most_rounds, kRoundsBeforeCells);
    if (finishing.certify.most_pairs_at_first == CertifyOptions().most_pairs_at_first) {
      finishing.certify.most_pairs_at_first = pairs_by_chance(surface->mesh.triangles.size());
    }
  }
  surface = finish_surface(soup, std::move(*surface), finishing, attempt, meter);
  if (options.certify.wanted && !attempt.certify.passed()) return std::nullopt;
  attempt.stages = std::move(report.stages);
  report = std::move(attempt);
  if (options.examine) options.examine(report);
  return surface;
}

}  // namespace meshrepair::internal
