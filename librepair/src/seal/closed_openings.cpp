// SPDX-License-Identifier: MIT
#include "closed_openings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <utility>
#include <vector>

#include <base/error.h>
#include <base/roots.h>
#include <check/soup_rays.h>
#include <mesh/mesh_parts.h>
#include <mesh/topology.h>

#include "openings.h"
#include "seal_lattice.h"
#include "wide_spaces.h"

namespace meshrepair::internal {
namespace {

// How far around an opening space is divided, in cubes: farther where a way leads around that.
constexpr std::array<std::int32_t, 3> kLatticeWidths = {1, 2, 4};

// Each share of the diagonal that is tried is twice the one before.
constexpr double kSmallestShareTried = 1.0 / 1024;

// Where many sizes are tried, each is to be found soon.
constexpr std::size_t kMostCubesOfMany = std::size_t{1} << 20;

// Openings whose area is less than this share of what a face of a cube has that is as large as what
// is behind: mouths of vessels have more.
constexpr double kSmallOpening = 1.0 / 9;

// Squares of lengths are numbers then, however large or small these are.
UnitScale scale_of(const TriangleSoup& mesh) { return UnitScale(std::array{half_extent_of(mesh)}); }

TriangleSoup scaled_soup(const TriangleSoup& mesh, const UnitScale& scale) {
  TriangleSoup scaled = mesh;
  for (Vec3d& p : scaled.points) p = scale(p);
  return scaled;
}

// All lengths are scaled but for those of the report.
class OpeningsCloser {
 public:
  OpeningsCloser(const Surface& solid, const SealOptions& options, const SealedSoFar& before,
                 SealReport& report, ProgressObserver* progress)
      : solid_(solid),
        options_(options),
        before_(before),
        report_(report),
        progress_(progress),
        cancel_only_(progress),
        scale_(scale_of(solid.mesh)),
        mesh_(scaled_soup(solid.mesh, scale_)),
        diagonal_(2 * half_extent_of(mesh_).norm()),
        no_winding_(mesh_.triangles.size(), 0),
        rays_(mesh_, no_winding_),
        openings_(
            mesh_, rays_,
            options.automatic ? std::min(options.most_cubes, kMostCubesOfMany) : options.most_cubes,
            before.bodies, options.automatic ? &cancel_only_ : progress) {}

  std::unique_ptr<ClosedOpenings> run() {
    if (options_.automatic) return close_smallest();
    const double size = scale_(options_.size);
    std::unique_ptr<ClosedOpenings> closed = close(size);
    if (closed || report_.step > 0) return closed;
    std::ostringstream text;
    text << "openings of " << options_.size
         << " are too small for this mesh to be found: give a size to seal from "
         << scale_.back(size_that_can_be_found(size)) << " on";
    throw ValueError(text.str());
  }

 private:
  // Those that hold a good part of what the solid does.
  std::unique_ptr<ClosedOpenings> close_smallest() {
    const double volume = std::abs(signed_volume(mesh_));
    const WideSpaces spaces(mesh_, progress_);
    for (double share = kSmallestShareTried; share <= kLargestShareTried; share *= 2) {
      // Half as large takes four times as long.
      if (progress_ != nullptr) progress_->advance(1 - kSmallestShareTried / share);
      const double size = share * diagonal_;
      if (scale_.back(size) <= before_.size || !spaces.lie_behind(size)) continue;
      std::unique_ptr<ClosedOpenings> closed = close(size);
      if (closed && leave_wide_mouths(*closed) >= kWorthSealing * volume) return closed;
    }
    report_ = {};
    return nullptr;
  }

  // Returns the volume of what is filled then.
  double leave_wide_mouths(ClosedOpenings& closed) {
    FilledChambers& filled = closed.filled;
    std::erase_if(filled.spaces, [&](const FilledSpace& space) {
      const double width = cube_root(space.volume);
      const bool is_wide = space.patches_area > kSmallOpening * width * width;
      if (is_wide) {
        for (const std::uint32_t c : space.chambers) filled.solid[c] = 0;
      }
      return is_wide;
    });
    const double unit = scale_(closed.soup.grid.unit);
    double volume = 0;
    for (const FilledSpace& space : filled.spaces) volume += space.volume * unit * unit * unit;
    tell_spaces(closed);
    return volume;
  }

  // Nothing if there is nothing to close; the report has no step if there would be too many cubes.
  std::unique_ptr<ClosedOpenings> close(double size) {
    report_ = {};
    report_.size = scale_.back(size);
    // A ball that is larger rolls around the whole hardly otherwise.
    const Openings::Found found = openings_.find(std::min(size, diagonal_));
    if (found == Openings::Found::too_many_cubes) return nullptr;
    report_.step = scale_.back(openings_.grid().step());
    if (found == Openings::Found::none) return nullptr;
    std::unique_ptr<ClosedOpenings> closed;
    for (const std::int32_t around : kLatticeWidths) {
      closed = cut(around);
      if (closed && closed->filled.leaks == 0) break;
    }
    if (!closed) {
      report_.cannot_cut = 1;
      return nullptr;
    }
    report_.leaks = closed->filled.leaks;
    if (closed->filled.spaces.empty()) return nullptr;
    tell_spaces(*closed);
    return closed;
  }

  void tell_spaces(const ClosedOpenings& closed) {
    const double unit = closed.soup.grid.unit;
    report_.openings = 0;
    report_.patches_area = report_.filled_volume = 0;
    for (const FilledSpace& space : closed.filled.spaces) {
      report_.openings += space.openings;
      report_.patches_area += space.patches_area * unit * unit;
      report_.filled_volume += space.volume * unit * unit * unit;
    }
  }

  // At least twice as large.
  [[nodiscard]] double size_that_can_be_found(double size) const {
    do size *= 2;
    while (size < diagonal_ && !openings_.can_find(size));
    return size;
  }

  [[nodiscard]] std::unique_ptr<ClosedOpenings> cut(std::int32_t around) const {
    SealLattice lattice =
        make_seal_lattice(openings_.grid(), openings_.reach(), openings_.closed(), around);
    for (Vec3d& p : lattice.soup.points) p = scale_.back(p);
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
  const SealedSoFar& before_;
  SealReport& report_;
  ProgressObserver* progress_;
  CancelOnly cancel_only_;
  UnitScale scale_;
  TriangleSoup mesh_;  // of the solid
  double diagonal_;
  std::vector<std::int32_t> no_winding_;
  SoupRays rays_;
  Openings openings_;
};

}  // namespace

std::unique_ptr<ClosedOpenings> close_openings(const Surface& body, const SealOptions& options,
                                               const SealedSoFar& before, SealReport& report,
                                               ProgressObserver* progress) {
  return OpeningsCloser(body, options, before, report, progress).run();
}

void add_seal(const SealReport& more, SealReport& report) {
  report.size = std::max(report.size, more.size);
  report.step = std::max(report.step, more.step);
  report.openings += more.openings;
  report.patches_area += more.patches_area;
  report.filled_volume += more.filled_volume;
  report.leaks += more.leaks;
  report.cannot_cut += more.cannot_cut;
}

}  // namespace meshrepair::internal
