// SPDX-License-Identifier: MIT
#include "report/thickness_report.h"

#include <algorithm>
#include <vector>

#include <spdlog/fmt/fmt.h>

#include "report/words.h"

namespace meshrepair {
namespace {

// Of each kind in the table; the report has more.
constexpr std::size_t kThinnestPerLine = 3;

// Worst first: the first that a triangle has is its colour.
constexpr std::array<ThinLook, kThinKinds> kLooks = {{
    {ThinKind::wall, "wall", "walls", "thin_walls", "violet", "of a thin wall", {130, 70, 200}},
    {ThinKind::pin, "pin", "pins", "thin_pins", "brown", "of a thin pin", {140, 90, 50}},
    {ThinKind::gap, "gap", "gaps", "narrow_gaps", "teal", "at a narrow gap", {0, 130, 140}},
    {ThinKind::edge,
     "sharp edge",
     "edges",
     "sharp_edges",
     "pink",
     "at a sharp edge",
     {250, 150, 180}},
}};

std::string line_of(const ThinLook& look, const ThinPlaces& places) {
  if (places.count == 0) return {};
  std::string text = fmt::format("          {}", number_of(places.count, look.noun));
  const std::size_t shown = std::min(kThinnestPerLine, places.first.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const ThinPlace& place = places.first[i];
    text += fmt::format("{}{:.4g} at ({:.6g}, {:.6g}, {:.6g})", i == 0 ? ": " : ", ",
                        place.thickness, place.at.x(), place.at.y(), place.at.z());
  }
  if (shown > 0 && places.count > shown) text += ", ...";
  return text + "\n";
}

double share_of(const ThinReport& thin) { return thin.area > 0 ? thin.thin_area / thin.area : 0; }

Json places_of(const ThinPlaces& places) {
  Json list = Json::array();
  for (const ThinPlace& place : places.first) {
    list.push_back({{"at", {place.at.x(), place.at.y(), place.at.z()}},
                    {"triangle", place.triangle},
                    {"thickness", place.thickness},
                    {"area", place.area}});
  }
  return {{"count", places.count}, {"area", places.area}, {"first", list}};
}

}  // namespace

const std::array<ThinLook, kThinKinds>& thin_looks() { return kLooks; }

std::optional<Colour> thin_colour(std::uint8_t marks) {
  for (const ThinLook& look : kLooks) {
    if ((marks >> static_cast<unsigned>(look.kind) & 1) != 0) return look.colour;
  }
  return {};
}

std::string thickness_text(const ThinReport& thin, bool is_solid) {
  const std::string_view caution =
      is_solid ? "" : "          no valid solid: told of the triangles as they are\n";
  if (thin.thin_area == 0) {
    return fmt::format("thin      nothing: no wall, gap or edge is thinner than {:.6g}\n{}",
                       thin.limit, caution);
  }
  std::string text =
      fmt::format("thin      {:.3g} % of the surface, area {:.6g}, is thinner than {:.6g}\n",
                  100 * share_of(thin), thin.thin_area, thin.limit);
  for (const ThinLook& look : kLooks) text += line_of(look, thin[look.kind]);
  return text.append(caution);
}

std::string thin_counts(const ThinReport& thin) {
  std::vector<std::string> counts;
  for (const ThinLook& look : kLooks) {
    const std::size_t count = thin[look.kind].count;
    if (count > 0) counts.push_back(number_of(count, look.noun));
  }
  return joined_with(", ", counts);
}

Json thickness_section(const ThinReport& thin) {
  Json section = {{"limit", thin.limit},
                  {"spacing", thin.spacing},
                  {"area", thin.thin_area},
                  {"share", share_of(thin)}};
  for (const ThinLook& look : kLooks) {
    section[std::string(look.section)] = places_of(thin[look.kind]);
  }
  return section;
}

void keep_places(ThinReport& thin, std::size_t most) {
  for (ThinPlaces& places : thin.kinds) places.first.resize(std::min(most, places.first.size()));
}

}  // namespace meshrepair
