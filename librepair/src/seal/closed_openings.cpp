#include "closed_openings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include <base/error.h>
#include <check/soup_rays.h>
#include <mesh/topology.h>

#include "openings.h"
#include "seal_lattice.h"
#include "wide_spaces.h"

namespace meshrepair::internal {
namespace {

// How far around an opening space is divided, in cubes: farther where a way leads around that.
constexpr std::array<std::int32_t, 3> kLatticeWidths = {1, 2, 4};

// What is tried where no size is given, as a share of the diagonal; each is twice the one before.
constexpr double kSmallestTried = 1.0 / 1024, kLargestTried = 1.0 / 8;

// Where many sizes are tried, each is to be found soon.
constexpr std::size_t kMostCubesOfMany = std::size_t{1} << 20;

// Openings whose area is less than this share of what a face of a cube has that is as large as what
// is behind: mouths of vessels have more.
constexpr double kSmallOpening = 1.0 / 9;

class OpeningsCloser {
 public:
  OpeningsCloser(const Surface& solid, const SealOptions& options, SealReport& report,
                 ProgressObserver* progress)
      : solid_(solid),
        options_(options),
        report_(report),
        progress_(progress),
        diagonal_(extent_of(solid.mesh).norm()),
        no_winding_(solid.mesh.triangles.size(), 0),
        rays_(solid.mesh, no_winding_),
        openings_(
            solid.mesh, rays_,
            options.automatic ? std::min(options.most_cubes, kMostCubesOfMany) : options.most_cubes,
            progress) {}

  std::unique_ptr<ClosedOpenings> run() {
    if (options_.automatic) return close_smallest();
    const double size = options_.is_share ? options_.size * diagonal_ : options_.size;
    std::unique_ptr<ClosedOpenings> closed = close(size);
    if (closed || report_.step > 0) return closed;
    std::ostringstream text;
    text << "openings of " << size
         << " are too small for this mesh to be found: give a larger size to seal";
    throw UsageError(text.str());
  }

 private:
  // Those that hold a good part of what the solid does.
  std::unique_ptr<ClosedOpenings> close_smallest() {
    const double volume = std::abs(signed_volume(solid_.mesh));
    const WideSpaces spaces(solid_.mesh, progress_);
    for (double share = kSmallestTried; share <= kLargestTried; share *= 2) {
      if (!spaces.lie_behind(share * diagonal_)) continue;
      std::unique_ptr<ClosedOpenings> closed = close(share * diagonal_);
      const bool is_worth =
          closed && report_.filled_volume >= kWorthSealing * volume &&
          report_.patches_area <= kSmallOpening * std::pow(report_.filled_volume, 2.0 / 3);
      if (is_worth) return closed;
    }
    report_ = {};
    return nullptr;
  }

  // Nothing if there is nothing to close; the report has no step if there would be too many cubes.
  std::unique_ptr<ClosedOpenings> close(double size) {
    report_ = {};
    report_.size = size;
    // A ball that is larger rolls around the whole hardly otherwise.
    const Openings::Found found = openings_.find(std::min(size, diagonal_));
    if (found == Openings::Found::too_many_cubes) return nullptr;
    report_.step = openings_.grid().step();
    if (found == Openings::Found::none) return nullptr;
    std::unique_ptr<ClosedOpenings> closed;
    for (const std::int32_t around : kLatticeWidths) {
      closed = cut(around);
      if (closed && closed->filled.leaks == 0) break;
    }
    report_.leaks = closed ? closed->filled.leaks : 1;
    if (!closed || closed->filled.openings == 0) return nullptr;
    const double unit = closed->soup.grid.unit;
    report_.openings = closed->filled.openings;
    report_.patches_area = closed->filled.patches_area * unit * unit;
    report_.filled_volume = closed->filled.volume * unit * unit * unit;
    return closed;
  }

  [[nodiscard]] std::unique_ptr<ClosedOpenings> cut(std::int32_t around) const {
    const SealLattice lattice =
        make_seal_lattice(openings_.grid(), openings_.reach(), openings_.closed(), around);
    auto closed = std::make_unique<ClosedOpenings>();
    closed->second = SecondSoup(solid_);
    const std::vector<std::uint32_t> none(lattice.soup.triangles.size(), Surface::kNoSource);
    closed->second.append(lattice.soup, none);
    CleanReport clean;
    closed->soup = clean_soup(closed->second.soup, clean, progress_);
    ArrangeReport arranged;
    std::optional<Arrangement> arrangement = Arrangement::make(closed->soup, arranged, progress_);
    if (!arrangement) return nullptr;
    closed->arrangement = std::make_unique<Arrangement>(std::move(*arrangement));
    std::optional<FilledChambers> filled = fill_behind(closed->soup, solid_.mesh.triangles.size(),
                                                       lattice, *closed->arrangement, progress_);
    if (!filled) return nullptr;
    closed->filled = std::move(*filled);
    return closed;
  }

  const Surface& solid_;
  const SealOptions& options_;
  SealReport& report_;
  ProgressObserver* progress_;
  double diagonal_;
  std::vector<std::int32_t> no_winding_;
  SoupRays rays_;
  Openings openings_;
};

}  // namespace

std::unique_ptr<ClosedOpenings> close_openings(const Surface& solid, const SealOptions& options,
                                               SealReport& report, ProgressObserver* progress) {
  std::unique_ptr<ClosedOpenings> closed = OpeningsCloser(solid, options, report, progress).run();
  report.automatic = options.automatic;
  return closed;
}

}  // namespace meshrepair::internal
