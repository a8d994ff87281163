#include "closed_and_open.h"

#include <algorithm>

#include <repair/walk.h>

namespace meshrepair::internal {
namespace {

SomeParts parts_that_are(bool closed, const CellGraph& graph, const Orientation& orientation) {
  IdVector<TriangleId, char> chosen;
  chosen.reserve(orientation.part_of.size());
  for (const std::uint32_t part : orientation.part_of) {
    chosen.push_back(orientation.parts[part].closed == closed ? 1 : 0);
  }
  SomeParts some{graph.of_triangles(chosen, orientation.winding), orientation};
  for (OrientedPart& part : some.orientation.parts) {
    if (part.closed != closed) part = {};
  }
  return some;
}

bool may_be_a_void(const OrientedPart& part) {
  return part.closed && part.believed && part.outward < 0;
}

}  // namespace

std::optional<ClosedAndOpen> closed_and_open_parts(const CellGraph& graph,
                                                   const Orientation& orientation,
                                                   ProgressObserver* progress) {
  const auto& parts = orientation.parts;
  const auto closed =
      std::count_if(parts.begin(), parts.end(), [](const OrientedPart& p) { return p.closed; });
  if (closed == 0 || static_cast<std::size_t>(closed) == parts.size()) return std::nullopt;
  if (std::any_of(parts.begin(), parts.end(), may_be_a_void)) return std::nullopt;
  if (walk_winding(graph, progress).consistent()) return std::nullopt;
  return ClosedAndOpen{parts_that_are(true, graph, orientation),
                       parts_that_are(false, graph, orientation)};
}

}  // namespace meshrepair::internal
