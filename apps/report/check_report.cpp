// SPDX-License-Identifier: MIT
#include "report/check_report.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <spdlog/fmt/fmt.h>

#include "report/thickness_report.h"
#include "report/words.h"

namespace meshrepair {
namespace {

// Of each defect in the table; the report has more.
constexpr std::size_t kPlacesPerLine = 3;
// A report is to be read, and a soup may have a million parts.
constexpr std::size_t kMostParts = 100;

struct DefectWords {
  Defect defect;
  std::string_view row;      // of the table
  std::string_view verdict;  // why it is no solid; empty if it is all the same
};

constexpr std::array<DefectWords, kDefects> kWords = {{
    {Defect::open_edge, "open edges", "not closed"},
    {Defect::nonmanifold_edge, "non-manifold edges", "not manifold"},
    {Defect::nonmanifold_vertex, "non-manifold vertices", "not manifold"},
    {Defect::inconsistent_edge, "edges with inconsistent orientation", "not oriented"},
    {Defect::inside_out_part, "parts that are inside out", "inside out"},
    {Defect::self_intersection, "intersecting pairs of triangles", "self-intersecting"},
    {Defect::degenerate_triangle, "degenerate triangles", "degenerate triangles"},
    {Defect::duplicate_triangle, "duplicate triangles", "duplicate triangles"},
    {Defect::not_finite_triangle, "triangles with NaN or infinity",
     "coordinates that are not numbers"},
    {Defect::unused_point, "unused points", ""},
}};

struct MarkColour {
  Defect defect;
  std::string_view name;
  std::string_view meaning;
  Colour colour;
};

// Worst first: the first that a triangle has is its colour.
constexpr std::array<MarkColour, 8> kColours = {{
    {Defect::degenerate_triangle, "black", "without area", {0, 0, 0}},
    {Defect::self_intersection, "red", "intersects another triangle", {220, 30, 30}},
    {Defect::duplicate_triangle, "magenta", "a duplicate", {210, 40, 200}},
    {Defect::nonmanifold_edge, "orange", "at a non-manifold edge", {245, 140, 20}},
    {Defect::open_edge, "yellow", "at an open edge", {245, 225, 40}},
    {Defect::inconsistent_edge, "blue", "oriented opposite to a neighbour", {40, 90, 230}},
    {Defect::inside_out_part, "green", "in a part that is inside out", {40, 170, 70}},
    {Defect::nonmanifold_vertex, "cyan", "at a non-manifold vertex", {50, 200, 210}},
}};
constexpr Colour kSound = {200, 200, 200};

std::string place_text(const Place& place) {
  if (!place.at.allFinite()) return fmt::format("triangle {}", place.ids[0]);
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", place.at.x(), place.at.y(), place.at.z());
}

std::string defect_line(const DefectWords& words, const DefectPlaces& places) {
  std::string text = fmt::format("{:<35}{:>12}", words.row, grouped(places.count));
  const std::size_t shown = std::min(kPlacesPerLine, places.first.size());
  for (std::size_t i = 0; i < shown; ++i) {
    text += (i == 0 ? "  at " : ", ") + place_text(places.first[i]);
  }
  if (shown > 0 && places.count > shown) text += ", ...";
  return text + "\n";
}

std::string verdict(const SurfaceCheck& check) {
  if (check.valid_solid())
    return "a valid solid: closed, manifold, oriented outward, free of self-intersections";
  std::vector<std::string_view> reasons;
  for (const DefectWords& words : kWords) {
    const bool told = std::find(reasons.begin(), reasons.end(), words.verdict) != reasons.end();
    if (check[words.defect].count > 0 && !words.verdict.empty() && !told) {
      reasons.push_back(words.verdict);
    }
  }
  if (reasons.empty()) reasons.emplace_back("encloses nothing");
  return fmt::format("NOT A VALID SOLID: {}", fmt::join(reasons, ", "));
}

std::string parts_text(const SurfaceCheck& check) {
  const auto closed = static_cast<std::size_t>(std::count_if(
      check.parts.begin(), check.parts.end(), [](const SurfacePart& part) { return part.closed; }));
  std::string text = fmt::format("{}, {} closed", number_of(check.parts.size(), "part"),
                                 closed == check.parts.size() ? "all" : grouped(closed));
  if (check.cavities > 0) {
    text += fmt::format(", {} the wall of a cavity", grouped(check.cavities));
  }
  return text;
}

std::string_view ids_name(Defect defect) {
  switch (defect) {
    case Defect::open_edge:
    case Defect::nonmanifold_edge:
    case Defect::inconsistent_edge:
    case Defect::nonmanifold_vertex:
    case Defect::unused_point:
      return "points";
    default:
      return "triangles";
  }
}

Json places_of(Defect defect, const DefectPlaces& places) {
  Json list = Json::array();
  for (const Place& place : places.first) {
    Json ids = Json::array({place.ids[0]});
    if (place.ids[1] != place.ids[0]) ids.push_back(place.ids[1]);
    list.push_back(
        {{std::string(ids_name(defect)), ids}, {"at", {place.at.x(), place.at.y(), place.at.z()}}});
  }
  return {{"count", places.count}, {"first", list}};
}

Json parts_of(const SurfaceCheck& check) {
  Json list = Json::array();
  for (std::size_t i = 0; i < std::min(kMostParts, check.parts.size()); ++i) {
    const SurfacePart& part = check.parts[i];
    Json volume = nullptr;
    if (part.closed) volume = part.volume;
    list.push_back({{"triangles", part.triangles},
                    {"first_triangle", part.first_triangle},
                    {"closed", part.closed},
                    {"depth", part.depth},
                    {"inside_out", part.inside_out},
                    {"volume", volume},
                    {"area", part.area}});
  }
  return list;
}

}  // namespace

std::string check_table(const SurfaceCheck& check, const std::string& what,
                        const std::vector<std::string>& attributes,
                        std::optional<LengthUnit> unit) {
  std::string text = what + "\n";
  for (const DefectWords& words : kWords) text += defect_line(words, check[words.defect]);
  text += fmt::format("parts     {}\n", parts_text(check));
  text += fmt::format("size      {}area {:.6g}, in {}\n",
                      check.closed() ? fmt::format("volume {:.6g}, ", check.volume) : "",
                      check.area, units_text(unit));
  if (!attributes.empty()) text += fmt::format("carries   {}\n", fmt::join(attributes, ", "));
  return text + "verdict   " + verdict(check) + "\n";
}

Json check_section(const SurfaceCheck& check) {
  Json defects;
  for (const DefectWords& words : kWords) {
    defects[std::string(defect_name(words.defect))] = places_of(words.defect, check[words.defect]);
  }
  const SelfIntersections& crossings = check.self_intersections;
  defects["self_intersections"]["crossing"] = crossings.crossing;
  defects["self_intersections"]["touching"] = crossings.touching;
  defects["self_intersections"]["coplanar"] = crossings.coplanar;
  Json volume = nullptr;
  if (check.closed()) volume = check.volume;
  return {{"valid_solid", check.valid_solid()},
          {"closed", check.closed()},
          {"manifold", check.manifold()},
          {"oriented", check.oriented()},
          {"outward", check.outward()},
          {"points", check.points},
          {"triangles", check.triangles},
          {"edges", check.edges},
          {"volume", volume},
          {"area", check.area},
          {"defects", defects},
          {"parts", check.parts.size()},
          {"cavities", check.cavities},
          {"first_parts", parts_of(check)}};
}

std::vector<Colour> defect_colours(const SurfaceCheck& check, std::span<const std::uint8_t> thin) {
  std::vector<Colour> colours;
  colours.reserve(check.marks.size());
  for (std::size_t t = 0; t < check.marks.size(); ++t) {
    const auto worst = std::find_if(kColours.begin(), kColours.end(), [&](const MarkColour& mark) {
      return (check.marks[t] >> static_cast<unsigned>(mark.defect) & 1) != 0;
    });
    const Colour otherwise = thin.empty() ? kSound : thin_colour(thin[t]).value_or(kSound);
    colours.push_back(worst == kColours.end() ? otherwise : worst->colour);
  }
  return colours;
}

std::vector<DefectLook> defect_looks() {
  std::vector<DefectLook> looks;
  looks.reserve(kColours.size());
  for (const MarkColour& mark : kColours) {
    looks.push_back({mark.defect, mark.meaning, mark.colour, true});
  }
  for (const DefectWords& words : kWords) {
    const bool is_there = std::any_of(looks.begin(), looks.end(), [&](const DefectLook& look) {
      return look.defect == words.defect;
    });
    if (!is_there) looks.push_back({words.defect, words.row, kSound, false});
  }
  return looks;
}

std::vector<std::string> colour_legend() {
  std::vector<std::string> lines;
  lines.reserve(kColours.size() + 1);
  for (const MarkColour& mark : kColours) {
    lines.push_back(fmt::format("{:<8} {}", mark.name, mark.meaning));
  }
  for (const ThinLook& look : thin_looks()) {
    lines.push_back(fmt::format("{:<8} {}, with --thickness", look.name, look.meaning));
  }
  lines.push_back(fmt::format("{:<8} {}", "grey", "no defect"));
  return lines;
}

}  // namespace meshrepair
