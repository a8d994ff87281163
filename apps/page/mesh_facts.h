// What a page says of one mesh, beside its triangles.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <check/check_surface.h>
#include <mesh/soup.h>

#include "common/explanation_file.h"
#include "common/json_report.h"
#include "page/pack_mesh.h"

namespace meshrepair {

// Of each kind of defect that are flown to, and whose edges are drawn.
inline constexpr std::size_t kMostPagePlaces = 1000;

struct ShownMesh {
  std::string_view role;  // "input" or "result"
  std::string name;       // for people
  const TriangleSoup& soup;
  SurfaceCheck check;                       // with marks, and up to kMostPagePlaces places
  std::vector<TriangleKind> kinds;          // that a triangle may be; empty: nothing is known
  std::vector<std::uint32_t> kind_of = {};  // of each triangle
};

// Of the check only the first `most` places of each defect stay.
void keep_places(SurfaceCheck& check, std::size_t most);

// `shown` is how many triangles are drawn. `section` is that of the check, as in the report.
[[nodiscard]] Json facts_of(const ShownMesh& mesh, Json section, std::size_t shown,
                            const PageGrid& grid);

// Of each defect its key, colour and words, and the bit of its marks, or null. Worst first.
[[nodiscard]] Json looks_of_defects();

}  // namespace meshrepair
