// SPDX-License-Identifier: MIT
// What a page says of one mesh, beside its triangles.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <check/check_surface.h>
#include <check/thin_places.h>
#include <mesh/attributes.h>
#include <mesh/soup.h>

#include "page/pack_mesh.h"
#include "pictures/explanation_file.h"
#include "report/json_report.h"

namespace meshrepair {

// Of each kind of defect that are flown to, and whose edges are drawn.
inline constexpr std::size_t kMostPagePlaces = 1000;

// What a triangle can be, with the colour that says so.
struct PageKind {
  std::string key;
  std::string words;
  Colour colour;
};
// Those of --explain.
[[nodiscard]] std::vector<PageKind> page_kinds(const std::vector<TriangleKind>& kinds);

// One of those that stand beside each other.
struct ShownObject {
  std::string name;           // for people
  std::size_t triangles = 0;  // of the soup, behind those of the objects before
  bool is_solid = false;
};

struct ShownMesh {
  std::string_view role;  // "input", "result", "a" or "b": its key in the report
  std::string name;       // for people
  const TriangleSoup& soup;
  std::optional<SurfaceCheck> check;        // with marks, and up to kMostPagePlaces places
  std::vector<PageKind> kinds = {};         // that a triangle may be; empty: nothing is known
  std::vector<std::uint32_t> kind_of = {};  // of each triangle
  std::optional<DrawnMesh> drawn = {};      // nothing: what drawn_mesh() makes of it
  const Attributes* attributes = nullptr;   // of it; null: none
  std::vector<ShownObject> objects = {};    // that it is made of; empty: nothing is known
  std::optional<ThinReport> thin = {};      // as the check; nothing: it was not looked for
};

// Of the check only the first `most` places of each defect stay.
void keep_places(SurfaceCheck& check, std::size_t most);

// What is drawn of it has to be there. `section` is that of the check, as in the report; null where
// there is none.
[[nodiscard]] Json facts_of(const ShownMesh& mesh, Json section, const PageGrid& grid);

// Of each triangle: bit d for Defect d, and bit kDefects + k for ThinKind k; none without a check.
[[nodiscard]] std::vector<std::uint16_t> page_marks(const ShownMesh& mesh);

// Of each defect its key, colour and words, and the bit of its marks, or null. Worst first; behind
// them what is thin, if that was looked for.
[[nodiscard]] Json looks_of_defects(bool has_thin);

}  // namespace meshrepair
