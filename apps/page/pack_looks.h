// SPDX-License-Identifier: MIT
// How a mesh looks, as few characters. web/viewer/src/looks.js reads it.
//
// The text is as that of pack_mesh.h. The lists are:
//
//   materials  one a triangle: 0 without a material, else its number from 1, twice, and 1 more if
//              its picture is to be drawn there
//   places     where has_places says so, three for each triangle with a picture: 0 is the next new
//              place in the picture, k the one that came k places before that
//   u, then v  of each such place, each with a sign, less the one before; steps of 1 / 8192
//   colours    where has_colours says so, three a triangle: 0 none, else as places, and 1 more
//   red, then green, then blue of each such colour, from 0 to 255
#pragma once

#include <optional>
#include <string>

#include <base/progress.h>
#include <mesh/attributes.h>

#include "page/drawn_mesh.h"
#include "page/page_pictures.h"
#include "report/json_report.h"

namespace meshrepair {

struct PackedLooks {
  Json facts;
  std::string text;
};

// `attributes` are those of the mesh of which `drawn` is made. Nothing where they say nothing of
// colours. Throws Cancelled.
[[nodiscard]] std::optional<PackedLooks> pack_looks(const Attributes& attributes,
                                                    const DrawnMesh& drawn, PagePictures& pictures,
                                                    ProgressObserver* progress);

}  // namespace meshrepair
