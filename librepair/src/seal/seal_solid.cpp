// From outside to inside:
//
// - A grid of cubes is laid around the surface, and a ball rolls through it: space_grid.h,
//   ball_reach.h. That tells where openings are, as well as cubes can.
// - There the faces of the cubes are added to the surface, and all is cut exactly. Of the faces the
//   smallest are taken that part what is behind from what is before: seal_lattice.h,
//   fill_behind.h. That closes what there is, whatever cubes have missed.
#include "seal_solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <base/error.h>
#include <check/soup_rays.h>
#include <extract/arrange.h>
#include <repair/repair.h>

#include "again/second_repair.h"
#include "ball_reach.h"
#include "fill_behind.h"
#include "report/describe_result.h"
#include "seal_lattice.h"
#include "space_grid.h"

namespace meshrepair::internal {
namespace {

// Of the grid across the ball's diameter. More than some only where that takes few cubes.
constexpr double kFewestSteps = 6, kSomeSteps = 12, kMostSteps = 48;
constexpr double kMargin = 2;  // steps beyond the radius in which distances are known

// How far around an opening space is divided, in cubes: farther where a way leads around that.
constexpr std::array<std::int32_t, 3> kAround = {1, 2, 4};

// Of the bounding box.
Vec3d extent_of(const TriangleSoup& soup) {
  Vec3d low = soup.points.front(), high = low;
  for (const Vec3d& p : soup.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return high - low;
}

[[noreturn]] void refuse_size(double size) {
  throw UsageError("openings of " + std::to_string(size) +
                   " are too small for this mesh to be found: give a larger size to seal");
}

// With as many steps across the ball as there may be cubes.
SpaceGrid make_grid(const TriangleSoup& soup, double size, std::size_t most_cubes,
                    ProgressObserver* progress) {
  const auto with_steps = [&](double steps) {
    const double step = size / steps;
    return SpaceGrid(soup, step, size / 2 + kMargin * step, progress);
  };
  const Vec3d bricks = extent_of(soup) / (SpaceGrid::kBrick * size / kFewestSteps);
  if ((bricks.array() + 8).prod() > static_cast<double>(most_cubes)) refuse_size(size);
  double steps = kFewestSteps;
  SpaceGrid grid = with_steps(steps);
  if (grid.cubes() > most_cubes) refuse_size(size);
  // Twice as many steps make up to eight times the cubes.
  while (steps < kMostSteps) {
    const std::size_t most = 2 * steps <= kSomeSteps ? most_cubes : most_cubes / 8;
    if (grid.cubes() > most / 4) break;
    steps *= 2;
    SpaceGrid finer = with_steps(steps);
    if (finer.cubes() > most) break;
    grid = std::move(finer);
  }
  return grid;
}

// The surface and the lattice on the working grid, and which chambers are solid then. Stays where
// it is, as the arrangement refers to the soup.
struct Sealed {
  SecondSoup second;
  CleanSoup soup;
  std::optional<Arrangement> arrangement;
  FilledChambers filled;
};

class Sealer {
 public:
  // The solid outlives this.
  Sealer(const Surface& solid, const RepairOptions& options, SealReport& report)
      : solid_(solid),
        options_(options),
        report_(report),
        no_winding_(solid.mesh.triangles.size(), 0),
        rays_(solid.mesh, no_winding_) {}

  // Nothing if there is nothing to seal.
  std::unique_ptr<Sealed> run() {
    report_.automatic = options_.seal.automatic;
    if (!find_openings()) return nullptr;
    std::unique_ptr<Sealed> sealed;
    for (const std::int32_t around : kAround) {
      sealed = seal(around);
      if (sealed && sealed->filled.leaks == 0) break;
    }
    report_.leaks = sealed ? sealed->filled.leaks : 1;
    if (!sealed || sealed->filled.openings == 0) return nullptr;
    const double unit = sealed->soup.grid.unit;
    report_.openings = sealed->filled.openings;
    report_.patches_area = sealed->filled.patches_area * unit * unit;
    report_.filled_volume = sealed->filled.volume * unit * unit * unit;
    return sealed;
  }

 private:
  [[nodiscard]] bool find_openings() {
    const double diagonal = extent_of(solid_.mesh).norm();
    report_.size = size_to_close(diagonal);
    if (report_.size <= 0) return false;
    // A ball that is larger rolls around the whole hardly otherwise.
    const double size = std::min(report_.size, diagonal);
    grid_ = make_grid(solid_.mesh, size, options_.seal.most_cubes, options_.progress);
    report_.step = grid_->step();
    grid_->measure(options_.progress);
    reach_.emplace(*grid_, rays_, size / 2);
    if (!reach_->find(options_.progress)) return false;
    closed_ = reach_->closed_faces(options_.progress);
    return true;
  }

  // 0 if there is none.
  [[nodiscard]] double size_to_close(double diagonal) const {
    const SealOptions& seal = options_.seal;
    if (!seal.automatic) return seal.is_share ? seal.size * diagonal : seal.size;
    const std::vector<Neck> necks =
        find_necks(solid_.mesh, kWorthSealing, seal.most_cubes / 4, options_.progress);
    return necks.empty() ? 0 : size_to_seal(necks.front());
  }

  [[nodiscard]] std::unique_ptr<Sealed> seal(std::int32_t around) const {
    const SealLattice lattice = make_seal_lattice(*grid_, *reach_, closed_, around);
    auto sealed = std::make_unique<Sealed>();
    sealed->second = SecondSoup(solid_);
    const std::vector<std::uint32_t> none(lattice.soup.triangles.size(), Surface::kNoSource);
    sealed->second.append(lattice.soup, none);
    CleanReport clean;
    sealed->soup = clean_soup(sealed->second.soup, clean, options_.progress);
    ArrangeReport arranged;
    sealed->arrangement = Arrangement::make(sealed->soup, arranged, options_.progress);
    if (!sealed->arrangement) return nullptr;
    std::optional<FilledChambers> filled =
        fill_behind(sealed->soup, solid_.mesh.triangles.size(), lattice, *sealed->arrangement,
                    options_.progress);
    if (!filled) return nullptr;
    sealed->filled = std::move(*filled);
    return sealed;
  }

  const Surface& solid_;
  const RepairOptions& options_;
  SealReport& report_;
  std::vector<std::int32_t> no_winding_;
  SoupRays rays_;
  std::optional<SpaceGrid> grid_;
  std::optional<BallReach> reach_;
  std::vector<BallReach::Face> closed_;
};

// Certified, where need be by repairing it once more.
Surface extract_sealed(const Sealed& sealed, const RepairOptions& options, RepairReport& report) {
  const std::vector<char>& solid = sealed.filled.solid;
  RepairOptions again = options_for_second(sealed.second, options);
  std::optional<Surface> surface =
      extract_mesh(sealed.soup, *sealed.arrangement, solid, again, report);
  if (surface) {
    refer_to_first(sealed.second, *surface);
    return std::move(*surface);
  }
  again.certify.wanted = false;
  again.slit_steps = 0;
  again.simplify = 0;
  report = {};
  surface = extract_mesh(sealed.soup, *sealed.arrangement, solid, again, report);
  if (!surface) throw InternalError("openings are sealed, but what is solid then has no boundary");
  refer_to_first(sealed.second, *surface);
  const SecondSoup third(*surface);
  report = {};
  Surface repaired = repair(third.soup, options_for_second(third, options), report);
  refer_to_first(third, repaired);
  return repaired;
}

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

}  // namespace

Surface seal_solid(const TriangleSoup& soup, Surface solid, const RepairOptions& options,
                   RepairReport& report) {
  std::unique_ptr<Sealed> sealed;
  {
    StageMeter meter(report.stages, options.progress);
    meter.begin("seal");
    sealed = Sealer(solid, options, report.seal).run();
  }
  if (!sealed) return solid;
  RepairReport second;
  Surface surface = extract_sealed(*sealed, options, second);
  append_report(std::move(second), report);
  note_fates(soup.triangles.size(), solid, surface, report);
  describe_output(surface, report);
  return surface;
}

}  // namespace meshrepair::internal
