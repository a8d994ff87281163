// SPDX-License-Identifier: MIT
// Points at which pieces of surface only touch.
#pragma once

#include <cstddef>
#include <vector>

#include "agreed_triangles.h"

namespace meshrepair {

// Where the triangles around a point are several fans, with gaps between, takes away all but the
// largest; again, until there are none. The holes then have simple rims, each on one sheet, that
// can be closed one by one. In an edge at most two triangles meet. `points` is more than any
// corner. Returns how many triangles were taken away.
std::size_t keep_single_fans(std::vector<VotedTriangle>& triangles, std::size_t points);

}  // namespace meshrepair
