// SPDX-License-Identifier: MIT
// Scans and exports of many triangles often bound a solid but for some places where rounding, or a
// fold, makes triangles meet. Each place is cut out with some rings of whole triangles, closed by a
// cap, and all these bodies are repaired as one small mesh. What comes of them, without the caps,
// takes its place in the rims again. What was not cut out was tested with all others, and what is
// new is tested with all: so the whole is certified without another look at all pairs.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <base/error.h>
#include <base/ids.h>
#include <check/part_orientation.h>
#include <check/self_intersections.h>
#include <exact/double_predicates.h>
#include <mesh/internal/triangle_measures.h>
#include <mesh/mesh_parts.h>
#include <mesh/topology.h>
#include <mesh/weld_points.h>

#include "again/second_repair.h"
#include "capped_places.h"
#include "keep_valid.h"
#include "nearly_solid.h"
#include "report/describe_result.h"

namespace meshrepair::internal {
namespace {

// Smaller ones are repaired as fast as a whole.
constexpr std::size_t kLarge = 20'000;
// Of the triangles: pairs that meet, and triangles of all places.
constexpr std::size_t kMostPairsShare = 64, kMostPlacesShare = 2;

class FewPlaces {
 public:
  FewPlaces(Surface closed, std::vector<std::uint32_t> part, const RepairOptions& options,
            const RepairPlaces& repair_places, std::vector<StageReport>& stages, StageMeter& meter)
      : options_(options),
        repair_places_(repair_places),
        stages_(stages),
        meter_(meter),
        quiet_(options.progress),
        surface_(std::move(closed)),
        part_(std::move(part)) {}

  std::optional<Surface> run() {
    const std::vector<std::uint32_t> seeds = find_seeds();
    if (seeds.empty()) return std::nullopt;
    find_least_area(seeds);
    auto places = cap_places(surface_.mesh, seeds, surface_.source.size() / kMostPlacesShare,
                             options_.certify.precision, &quiet_);
    if (!places) return std::nullopt;
    places_ = std::move(*places);
    const std::optional<Surface> repaired = repair();
    if (!repaired) return std::nullopt;
    input_ = examine_topology(surface_.mesh.triangles, surface_.mesh.points.size());
    input_area_ = surface_area(surface_.mesh);
    input_volume_ = signed_volume(surface_.mesh);
    if (!put_back(*repaired) || !is_solid()) return std::nullopt;
    return std::move(surface_);
  }

  // What the repair of the places found and did, without their caps, as that of the whole; but for
  // what is said of the output.
  [[nodiscard]] RepairReport take_report() {
    const std::size_t caps = places_.soup.triangles.size() - places_.triangle.size();
    report_.clean.triangles_in = part_.size();
    report_.input = input_;
    report_.input_area = input_area_;
    report_.input_volume = input_volume_;
    report_.orient.parts = input_.parts;
    report_.parts.places.clear();
    report_.parts.bounding_triangles += first_new_ - caps;
    report_.triangles.untouched = untouched_;
    report_.triangles.cut = report_.parts.bounding_triangles - untouched_;
    return std::move(report_);
  }

 private:
  // Those that meet others, and those without area. None where they are many.
  std::vector<std::uint32_t> find_seeds() {
    const TriangleSoup& mesh = surface_.mesh;
    const std::size_t most = mesh.triangles.size() / kMostPairsShare;
    SelfIntersectionOptions options;
    options.most_pairs = options.enough = most;
    options.progress = &quiet_;
    const SelfIntersections found = self_intersections(mesh, options);
    if (found.count > most || found.degenerate > most || found.not_finite > 0) return {};
    std::vector<std::uint32_t> seeds;
    for (const auto& pair : found.pairs) seeds.insert(seeds.end(), pair.begin(), pair.end());
    for (std::uint32_t t = 0; found.degenerate > 0 && t < mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      if (projection_axis(mesh.points[a], mesh.points[b], mesh.points[c]) < 0) seeds.push_back(t);
    }
    return seeds;
  }

  // Of the parts with places.
  void find_least_area(std::span<const std::uint32_t> seeds) {
    const TriangleSoup& mesh = surface_.mesh;
    std::vector<double> area(*std::max_element(part_.begin(), part_.end()) + std::size_t{1}, 0);
    for (std::size_t t = 0; t < part_.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      area[part_[t]] += triangle_area(mesh.points[a], mesh.points[b], mesh.points[c]);
    }
    least_area_ = area[part_[seeds.front()]];
    for (const std::uint32_t t : seeds) least_area_ = std::min(least_area_, area[part_[t]]);
  }

  std::optional<Surface> repair() {
    SecondSoup second;
    second.soup = places_.soup;
    second.first_added = places_.triangle.size();
    second.source = places_.triangle;
    second.source.resize(second.soup.triangles.size(), Surface::kNoSource);
    RepairOptions again = options_for_second(second, options_);
    again.inside = options_.inside;
    again.inside.least_solid_area = least_area_;
    again.join_gaps = {};
    again.states = nullptr;
    again.progress = &quiet_;
    // As for the whole: places are where triangles meet.
    again.certify.most_pairs_at_first = pairs_by_chance(surface_.source.size());
    meter_.end();
    std::optional<Surface> repaired;
    try {
      repaired = repair_places_(second.soup, again, report_);
    } catch (const NoSolidError&) {
      repaired.reset();
    }
    stages_.insert(stages_.end(), report_.stages.begin(), report_.stages.end());
    meter_.begin("places");
    const bool is_sure = report_.inside.used == InsideRule::winding && report_.certify.passed();
    if (!is_sure) repaired.reset();
    return repaired;
  }

  // Takes the place of what was cut out. False where a cap is not as it was.
  bool put_back(const Surface& repaired) {
    const auto first_cap = static_cast<std::uint32_t>(places_.triangle.size());
    std::vector<std::uint32_t> point(repaired.mesh.points.size(), kNone);  // of the surface
    std::vector<char> is_whole(places_.soup.triangles.size(), 0);
    for (std::size_t t = 0; t < repaired.source.size(); ++t) {
      const std::uint32_t source = repaired.source[t];
      if (source == Surface::kNoSource) continue;
      const std::size_t first = first_same_corner(repaired.mesh, t, source);
      if (first < 3) is_whole[source] = 1;
      if (first < 3 && source >= first_cap) note_rim(repaired.mesh, t, first, source, point);
    }
    for (std::uint32_t s = 0; s < is_whole.size(); ++s) {
      if (s >= first_cap && is_whole[s] == 0) return false;
      if (s < first_cap && is_whole[s] != 0) untouched_ += is_as_given(places_.triangle[s]) ? 1 : 0;
    }
    drop_places();
    const std::vector<std::uint32_t> place =
        first_in_place(places_.soup.points, repaired.mesh.points);
    for (std::size_t p = 0; p < point.size(); ++p) {
      if (point[p] != kNone) continue;
      point[p] = static_cast<std::uint32_t>(surface_.mesh.points.size());
      surface_.mesh.points.push_back(repaired.mesh.points[p]);
      const bool is_given =
          place[p] < places_.point.size() && surface_.input_point[places_.point[place[p]]] != 0;
      surface_.input_point.push_back(is_given ? repaired.input_point[p] : char{0});
    }
    first_new_ = surface_.source.size();
    for (std::size_t t = 0; t < repaired.source.size(); ++t) {
      std::uint32_t source = repaired.source[t];
      if (source != Surface::kNoSource && source >= first_cap) continue;
      if (source != Surface::kNoSource) source = source_of_[source];
      const auto& [a, b, c] = repaired.mesh.triangles[t];
      surface_.mesh.triangles.push_back({point[a], point[b], point[c]});
      surface_.source.push_back(source);
    }
    return true;
  }

  // Which corner of a triangle of the result is the first one of its source, if it has the corners
  // of that in their order; else 3.
  [[nodiscard]] std::size_t first_same_corner(const TriangleSoup& mesh, std::size_t t,
                                              std::uint32_t source) const {
    const IndexTriangle& from = places_.soup.triangles[source];
    const IndexTriangle& to = mesh.triangles[t];
    for (std::size_t first = 0; first < 3; ++first) {
      bool is_same = true;
      for (std::size_t k = 0; k < 3 && is_same; ++k) {
        is_same = mesh.points[to[(first + k) % 3]] == places_.soup.points[from[k]];
      }
      if (is_same) return first;
    }
    return 3;
  }

  // The corners of an unchanged cap are those of the surface, but for the tip.
  void note_rim(const TriangleSoup& mesh, std::size_t t, std::size_t first, std::uint32_t cap,
                std::vector<std::uint32_t>& point) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = places_.soup.triangles[cap][k];
      const bool is_tip = from >= places_.point.size();
      point[mesh.triangles[t][(first + k) % 3]] = is_tip ? 0 : places_.point[from];
    }
  }

  // Of the closed surface: not rounded.
  [[nodiscard]] bool is_as_given(std::size_t t) const {
    const IndexTriangle& corners = surface_.mesh.triangles[t];
    return std::all_of(corners.begin(), corners.end(),
                       [&](std::uint32_t p) { return surface_.input_point[p] != 0; });
  }

  void drop_places() {
    std::vector<char> is_out(surface_.source.size(), 0);
    source_of_.clear();
    for (const std::uint32_t t : places_.triangle) {
      is_out[t] = 1;
      source_of_.push_back(surface_.source[t]);
    }
    std::size_t kept = 0;
    for (std::size_t t = 0; t < is_out.size(); ++t) {
      if (is_out[t] != 0) continue;
      untouched_ += is_as_given(t) ? 1 : 0;
      surface_.mesh.triangles[kept] = surface_.mesh.triangles[t];
      surface_.source[kept++] = surface_.source[t];
    }
    surface_.mesh.triangles.resize(kept);
    surface_.source.resize(kept);
  }

  bool is_solid() {
    std::vector<std::uint32_t> fresh(surface_.source.size() - first_new_);
    std::iota(fresh.begin(), fresh.end(), static_cast<std::uint32_t>(first_new_));
    SelfIntersectionOptions options;
    options.enough = 0;
    options.progress = &quiet_;
    const SelfIntersections found = self_intersections(surface_.mesh, fresh, options);
    if (found.count + found.degenerate + found.not_finite > 0) return false;
    if (!is_manifold_as_asked(surface_.mesh, written_as(options_))) return false;
    sort_by_source();
    keep_triangles(surface_, std::vector<char>(surface_.source.size(), 1));
    const PartOrientation parts = examine_part_orientation(surface_.mesh, &quiet_);
    for (std::size_t part = 0; part < parts.depth.size(); ++part) {
      // What is meant by parts in parts, the whole tells.
      if (parts.inside_out[part] != 0 || parts.depth[part] > 0) return false;
    }
    return true;
  }

  // So that triangles come in the order of the input.
  void sort_by_source() {
    std::vector<std::uint32_t> order(surface_.source.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto less = [&](std::uint32_t a, std::uint32_t b) {
      return surface_.source[a] < surface_.source[b];
    };
    const auto middle = order.begin() + static_cast<std::ptrdiff_t>(first_new_);
    std::stable_sort(middle, order.end(), less);
    std::inplace_merge(order.begin(), middle, order.end(), less);
    Surface sorted;
    sorted.mesh.triangles.reserve(order.size());
    sorted.source.reserve(order.size());
    for (const std::uint32_t t : order) {
      sorted.mesh.triangles.push_back(surface_.mesh.triangles[t]);
      sorted.source.push_back(surface_.source[t]);
    }
    surface_.mesh.triangles = std::move(sorted.mesh.triangles);
    surface_.source = std::move(sorted.source);
  }

  const RepairOptions& options_;
  const RepairPlaces& repair_places_;
  std::vector<StageReport>& stages_;
  StageMeter& meter_;
  CancelOnly quiet_;
  Surface surface_;
  std::vector<std::uint32_t> part_;  // of each triangle as given
  double least_area_ = 0;
  CappedPlaces places_;
  std::vector<std::uint32_t> source_of_;  // of each triangle of the places
  std::size_t first_new_ = 0;
  std::size_t untouched_ = 0;
  RepairReport report_;  // of the places with their caps
  Topology input_;       // of the whole
  double input_area_ = 0, input_volume_ = 0;
};

// Bodies that cross do so in more than places, mostly.
bool parts_meet(const SelfIntersections& found, std::span<const std::uint32_t> part) {
  return std::any_of(found.pairs.begin(), found.pairs.end(),
                     [&](const auto& pair) { return part[pair[0]] != part[pair[1]]; });
}

}  // namespace

std::optional<Surface> repair_in_places(NearlySolid nearly, const RepairOptions& options,
                                        const RepairPlaces& repair_places, RepairReport& report,
                                        StageMeter& meter) {
  if (nearly.surface.source.size() < kLarge || !options.certify.wanted) return std::nullopt;
  meter.begin("places");
  std::vector<std::uint32_t> part = find_parts(nearly.surface.mesh).of_triangle;
  if (parts_meet(nearly.found, part)) return std::nullopt;
  FewPlaces places(std::move(nearly.surface), std::move(part), options, repair_places,
                   report.stages, meter);
  std::optional<Surface> surface = places.run();
  if (!surface || !tells_voids(*surface, options.inside)) return std::nullopt;
  meter.begin("check");
  std::vector<StageReport> stages = std::move(report.stages);
  report = places.take_report();
  report.stages = std::move(stages);
  describe_output(*surface, report);
  if (options.examine) options.examine(report);
  return surface;
}

}  // namespace meshrepair::internal
