// What is closed by itself beside what is not.
#pragma once

#include <optional>

#include <repair/cell_graph.h>
#include <repair/orient_parts.h>

namespace meshrepair::internal {

// Some of the parts, as if the others were not there.
struct SomeParts {
  CellGraph graph;
  Orientation orientation;  // says nothing of the others
};

struct ClosedAndOpen {
  SomeParts closed, open;
};

// A part that is closed is solid whatever open sheets there are, and these enclose what they do
// without it: so they may be decided apart. Nothing where all parts are closed, or none is, or
// where the windings contradict each other nowhere, so that there is nothing to doubt; or where a
// closed part faces inward, which may be the wall of a void in what has open edges.
[[nodiscard]] std::optional<ClosedAndOpen> closed_and_open_parts(const CellGraph& graph,
                                                                 const Orientation& orientation,
                                                                 ProgressObserver* progress);

}  // namespace meshrepair::internal
