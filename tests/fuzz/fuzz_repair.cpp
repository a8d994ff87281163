// SPDX-License-Identifier: MIT
// The whole way: any soup is refused by one of the exceptions that are meant for it, or becomes a
// surface that is what the report says, by an examination that shares nothing with the repair.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <base/error.h>
#include <bsp/clean_soup.h>
#include <bsp/tree_io.h>
#include <check/check_surface.h>
#include <check/self_intersections.h>
#include <mesh/precision.h>
#include <mesh/soup_io.h>
#include <repair/repair.h>

#include "repair_request.h"
#include "require_surface.h"
#include "triangles_by_place.h"

namespace meshrepair::testing {
namespace {

struct Outcome {
  std::optional<Surface> surface;  // if any
  RepairReport report;
  std::string refusal;
};

template <class Work>
Outcome outcome_of(Work work) {
  Outcome outcome;
  try {
    outcome.surface = work(outcome.report);
  } catch (const NoSolidError& error) {
    outcome.refusal = error.what();
  } catch (const OutputError& error) {
    outcome.refusal = error.what();
  } catch (const UsageError& error) {  // a size that does not fit the soup
    outcome.refusal = error.what();
  }
  return outcome;
}

Outcome repair_at_once(const TriangleSoup& soup, const RepairOptions& options) {
  return outcome_of([&](RepairReport& report) { return repair(soup, options, report); });
}

Outcome repair_in_steps(const TriangleSoup& soup, const RepairOptions& options) {
  return outcome_of([&](RepairReport& report) {
    Tree tree = parse_tree(format_tree(make_tree(soup, options, report)), "tree");
    label_tree(tree, options, report);
    return extract_mesh(parse_tree(format_tree(tree), "tree"), options, report);
  });
}

// As it would come back from a file.
TriangleSoup as_written(const Surface& surface, const CertifyOptions& options) {
  if (!options.welded) return surface.mesh;
  return as_read_back(surface.mesh, options.precision == Precision::float32
                                        ? SoupFormat::stl_binary
                                        : SoupFormat::stl_ascii);
}

void require_sound_numbers(const Surface& surface, const TriangleSoup& input, Precision precision) {
  for (const Vec3d& p : surface.mesh.points) {
    require(p.allFinite(), "a coordinate is not finite");
    require(precision == Precision::float64 || rounded_to_float32(p) == p,
            "a coordinate is not in single precision");
  }
  require(surface.source.size() == surface.mesh.triangles.size(), "a triangle has no source");
  for (const std::uint32_t source : surface.source) {
    require(source == Surface::kNoSource || source < input.triangles.size(),
            "a source is out of range");
  }
}

void require_sound_report(const RepairReport& report) {
  const bool exact = report.predicates == Predicates::exact;
  require(!exact || report.clip.fallbacks() == 0, "the clipper fell back");
  require(report.tree.lost_fragments == 0, "the tree lost a fragment");
  require(report.output.closed() && report.output.manifold() && report.output.oriented(),
          "the report denies what holds");
  // What crosses itself once rounded, and says so, may be of any volume.
  if (!report.certify.passed()) return;
  // Beyond this the volume is no finite number.
  constexpr double kLargest = 0x1p+300;
  if (!(report.output_area < kLargest)) return;
  // Not positive only where it is thinner than the numbers tell.
  const double size = std::pow(report.output_area, 1.5);
  require(report.output_volume >= -1e-9 * size, "the volume is negative");
}

void require_true_certificate(const Surface& surface, const CertifyReport& report,
                              const CertifyOptions& options) {
  require(report.done, "there is no certificate");
  const SurfaceCheck check = check_surface(as_written(surface, options));
  // Where the format joins points, sheets that cross along an edge have that edge in common once
  // they are read: then it is the surface itself that is spoken of.
  const std::size_t pairs = report.joined_points == 0 ? check.self_intersections.count
                                                      : self_intersections(surface.mesh).count;
  require(pairs == report.pairs, "other triangles intersect");
  require(check.self_intersections.degenerate == report.degenerate, "others are degenerate");
  if (!report.passed()) return;
  require_valid_solid(check);
}

void require_sound(const Outcome& outcome, const TriangleSoup& input,
                   const RepairOptions& options) {
  if (!outcome.surface) {
    require(outcome.refusal.find('\n') == std::string::npos, "a refusal has several lines");
    return;
  }
  require_sound_numbers(*outcome.surface, input, options.certify.precision);
  require_closed_manifold(check_surface(outcome.surface->mesh));
  require_sound_report(outcome.report);
  require_true_certificate(*outcome.surface, outcome.report.certify, options.certify);
}

bool same_bits(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3d)) == 0;
}

void require_same(const Outcome& a, const Outcome& b, const std::string& what) {
  require(a.surface.has_value() == b.surface.has_value(), what + " decides of solid or none");
  if (!a.surface) return;
  require(a.surface->mesh.triangles == b.surface->mesh.triangles, what + " changes triangles");
  require(same_bits(a.surface->mesh.points, b.surface->mesh.points), what + " changes points");
  require(a.surface->source == b.surface->source, what + " changes sources");
}

TriangleSoup with_some_turned(TriangleSoup soup, std::uint64_t chosen) {
  for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
    if ((chosen >> i % 64 & 1) != 0) std::swap(soup.triangles[i][1], soup.triangles[i][2]);
  }
  return soup;
}

TriangleSoup with_some_copied(TriangleSoup soup, std::uint64_t chosen) {
  const std::size_t count = soup.triangles.size();
  for (std::size_t i = 0; i < count; ++i) {
    auto t = soup.triangles[i];
    std::rotate(t.begin(), t.begin() + 1, t.end());
    if ((chosen >> i % 64 & 1) != 0) soup.triangles.push_back(t);
  }
  return soup;
}

bool is_blind_to_orientation(InsideRule rule) {
  return rule == InsideRule::solidity || rule == InsideRule::parity;
}

// How the triangles that are left count: layers, and how they are turned.
std::vector<std::pair<std::int32_t, std::int32_t>> counts_of(const TriangleSoup& soup,
                                                             bool blind_to_orientation) {
  CleanReport report;
  std::vector<std::pair<std::int32_t, std::int32_t>> counts;
  for (const Triangle& t : clean_soup(soup, report).triangles) {
    counts.emplace_back(t.layers, blind_to_orientation ? 0 : t.winding);
  }
  return counts;
}

void require_unchanged(const RepairRequest& request, const Outcome& outcome) {
  const TriangleSoup& soup = request.soup;
  const RepairOptions& options = request.options;
  const bool blind = is_blind_to_orientation(options.inside.rule);
  // A face that is there several times is one, unless as many layers of it balance the edges around
  // better. So a copy more may count, and other layers may after that.
  const auto require_same_from = [&](const TriangleSoup& changed, const std::string& what) {
    const Outcome other = repair_at_once(changed, options);
    require_sound(other, changed, options);
    if (counts_of(soup, blind) == counts_of(changed, blind)) require_same(outcome, other, what);
  };
  switch (request.change) {
    case Change::none:
      return;
    case Change::turn_some:
      if (!blind) return;
      return require_same_from(with_some_turned(soup, request.chosen), "turning triangles");
    case Change::copy_some:
      return require_same_from(with_some_copied(soup, request.chosen), "copying triangles");
    case Change::take_steps:
      return require_same(outcome, repair_in_steps(soup, options), "taking steps");
  }
}

// Chambers know no edges of cells: they give fewer triangles at times, of the same solid.
void require_same_solid(const RepairReport& a, const RepairReport& b) {
  constexpr double kLastBits = 1e-9;
  require(a.inside.used == b.inside.used, "chambers are decided otherwise");
  require(a.inside.left_out_folds == b.inside.left_out_folds, "chambers have other folds");
  require(a.parts.bounding_triangles == b.parts.bounding_triangles, "chambers keep others");
  const double size = std::pow(a.output_area, 1.5);
  if (!std::isfinite(size)) return;
  require(std::abs(a.output_area - b.output_area) <= kLastBits * a.output_area,
          "chambers have another area");
  require(std::abs(a.output_volume - b.output_volume) <= kLastBits * size,
          "chambers have another volume");
}

bool is_made_by_chambers(const RepairReport& report) { return report.arrange.chambers > 0; }

bool has_thin_cells(const RepairReport& report) {
  return report.thin_cells.filled + report.thin_cells.emptied > 0;
}

// The usual way: what is made without cells is sound, and what the cells give. What is sealed,
// thickened or left out then follows from last bits.
void require_same_without_cells(const RepairRequest& request, const Outcome& outcome) {
  RepairOptions options = request.options;
  options.all_cells = false;
  const Outcome spared = repair_at_once(request.soup, options);
  require_sound(spared, request.soup, options);
  if (options.seal.wanted() || options.thicken.wanted() || options.keep.wanted()) return;
  if (!options.opacity.empty()) return;  // cells may take the rule that is surer
  const bool by_chambers = is_made_by_chambers(spared.report);
  if (!by_chambers && !spared.report.spared_cells) return;
  if (by_chambers) require(spared.report.certify.passed(), "chambers give what is not certified");
  require(outcome.surface.has_value(), "cells find no solid");
  if (spared.report.spared_cells) {
    require(triangles_by_place(outcome.surface->mesh) == triangles_by_place(spared.surface->mesh),
            "cells give other triangles");
    return;
  }
  const bool is_moved =
      spared.report.certify.pairs_at_first + outcome.report.certify.pairs_at_first > 0;
  if (is_moved || options.certify.precision != Precision::float64) return;
  if (!has_thin_cells(outcome.report)) require_same_solid(outcome.report, spared.report);
}

void check(FuzzInput& input) {
  const RepairRequest request = decode_request(input);
  const Outcome outcome = repair_at_once(request.soup, request.options);
  require_sound(outcome, request.soup, request.options);
  require_same_without_cells(request, outcome);
  require_unchanged(request, outcome);
}

}  // namespace
}  // namespace meshrepair::testing

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  meshrepair::testing::FuzzInput input(data, size);
  meshrepair::testing::check(input);
  return 0;
}
