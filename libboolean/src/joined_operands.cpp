#include "joined_operands.h"

#include <algorithm>
#include <utility>

#include <mesh/append_soup.h>
#include <repair/join_gaps.h>
#include <repair/valid_solid.h>

namespace meshrepair::internal {
namespace {

// The triangles of an operand, with the points that they have.
TriangleSoup triangles_of(const TriangleSoup& all, std::size_t first, std::size_t last) {
  constexpr std::uint32_t kUnused = ~std::uint32_t{0};
  std::vector<std::uint32_t> number(all.points.size(), kUnused);
  TriangleSoup soup;
  for (std::size_t t = first; t < last; ++t) {
    soup.triangles.push_back(all.triangles[t]);
    for (std::uint32_t& p : soup.triangles.back()) {
      if (number[p] == kUnused) {
        number[p] = static_cast<std::uint32_t>(soup.points.size());
        soup.points.push_back(all.points[p]);
      }
      p = number[p];
    }
  }
  return soup;
}

Surface as_solid(const TriangleSoup& soup, const BooleanOptions& options) {
  RepairOptions repairing;
  repairing.simplify = 0;
  CancelOnly quiet(options.repair.progress);
  repairing.progress = &quiet;
  if (auto kept = valid_solid(soup, repairing.certify, &quiet)) return std::move(*kept);
  RepairReport report;
  return repair(soup, repairing, report);
}

}  // namespace

std::optional<JoinedOperands> join_operands(std::span<const TriangleSoup> solids,
                                            const BooleanOptions& options, JoinGapsReport& report) {
  JoinGapsOptions joining = options.repair.join_gaps;
  joining.progress = options.repair.progress;
  if (joining.mode == JoinGapsMode::none) return std::nullopt;
  TriangleSoup all;
  for (const TriangleSoup& solid : solids) append_soup(all, solid);
  const std::optional<JoinedSoup> joined = join_gaps(all, joining, report);
  if (!joined) return std::nullopt;
  JoinedOperands operands;
  std::size_t first = 0, given = 0;
  for (const TriangleSoup& solid : solids) {
    given += solid.triangles.size();
    const auto after = std::lower_bound(joined->source.begin(), joined->source.end(), given);
    const auto last = static_cast<std::size_t>(after - joined->source.begin());
    Surface surface;
    if (first < last) surface = as_solid(triangles_of(joined->soup, first, last), options);
    for (const std::uint32_t t : surface.source) {
      operands.source.push_back(t == Surface::kNoSource ? t : joined->source[first + t]);
    }
    operands.solids.push_back(std::move(surface.mesh));
    first = last;
  }
  return operands;
}

}  // namespace meshrepair::internal
