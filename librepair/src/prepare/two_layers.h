// SPDX-License-Identifier: MIT
// Surfaces that are there twice, one layer on the other: game engines and their exporters give each
// face a copy that faces the other way. Copies with the same corners clean_soup() joins; these are
// those that it does not see.
#pragma once

#include <optional>

#include <base/progress.h>
#include <bsp/clean_soup.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

// Copies of a face that are cut into triangles along other diagonals become copies of the first
// where as many face either way: their triangles go, and those of the first wind around nothing,
// as clean_soup() has triangles that are there both ways round. A face is the triangles
// between edges at which the surface does not simply go on; it is nearly flat and has no corner
// inside. Copies stay in parts of which hardly anything is there twice.
void join_cuts(CleanSoup& soup, ProgressObserver* progress);

// The soup, with the corners of a second layer moved to those of the first where they are apart by
// rounding alone and then make faces of one layer faces of the other, turned round. Layers with
// walls between them are no such layers, but a thin solid. `clean` is the soup on the grid. Nothing
// where there is no second layer.
[[nodiscard]] std::optional<TriangleSoup> bring_layers_together(const TriangleSoup& soup,
                                                                const CleanSoup& clean,
                                                                ProgressObserver* progress);

}  // namespace meshrepair::internal
