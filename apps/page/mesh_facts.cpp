// SPDX-License-Identifier: MIT
#include "page/mesh_facts.h"

#include <algorithm>
#include <array>
#include <utility>

#include <base/assert.h>

#include "report/check_report.h"
#include "report/thickness_report.h"

namespace meshrepair {
namespace {

void append(const PageGrid::Steps& steps, Json& list) {
  for (const std::int32_t step : steps) list.push_back(step);
}

bool is_of_edges(Defect defect) {
  return defect == Defect::open_edge || defect == Defect::nonmanifold_edge ||
         defect == Defect::inconsistent_edge;
}

// Where it is in steps, and, of an edge, where it ends.
Json places_of(const ShownMesh& mesh, Defect defect, const PageGrid& grid) {
  Json at = Json::array();
  Json ends = Json::array();
  const std::vector<Place>& places = (*mesh.check)[defect].first;
  for (std::size_t i = 0; i < std::min(kMostPagePlaces, places.size()); ++i) {
    if (!places[i].at.allFinite()) continue;
    append(grid.steps_of(places[i].at), at);
    if (!is_of_edges(defect)) continue;
    for (const std::uint32_t p : places[i].ids) append(grid.steps_of(mesh.soup.points[p]), ends);
  }
  return {{"at", at}, {"ends", ends}};
}

Json places_of(const ShownMesh& mesh, const PageGrid& grid) {
  Json all = Json::object();
  if (!mesh.check) return all;
  for (std::size_t d = 0; d < kDefects; ++d) {
    const auto defect = static_cast<Defect>(d);
    all[std::string(defect_name(defect))] = places_of(mesh, defect, grid);
  }
  if (!mesh.thin) return all;
  for (const ThinLook& look : thin_looks()) {
    Json at = Json::array();
    const std::vector<ThinPlace>& places = (*mesh.thin)[look.kind].first;
    for (std::size_t i = 0; i < std::min(kMostPagePlaces, places.size()); ++i) {
      append(grid.steps_of(places[i].at), at);
    }
    all[std::string(look.key)] = {{"at", at}, {"ends", Json::array()}};
  }
  return all;
}

Json kinds_of(const ShownMesh& mesh) {
  std::vector<std::size_t> counts(mesh.kinds.size(), 0);
  for (const std::uint32_t kind : mesh.kind_of) ++counts[kind];
  Json list = Json::array();
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const PageKind& kind = mesh.kinds[k];
    list.push_back(
        {{"key", kind.key}, {"words", kind.words}, {"colour", kind.colour}, {"count", counts[k]}});
  }
  return list;
}

Json middle_of(const TriangleSoup& soup, const std::array<std::uint32_t, 3>& triangle,
               const PageGrid& grid) {
  Vec3d middle = Vec3d::Zero();
  for (const std::uint32_t p : triangle) middle += soup.points[p] / 3;
  Json place = Json::array();
  append(grid.steps_of(middle), place);
  return place;
}

// In the middle of a triangle of each part that the section lists.
Json part_places(const ShownMesh& mesh, std::size_t listed, const PageGrid& grid) {
  Json list = Json::array();
  for (std::size_t i = 0; i < listed; ++i) {
    const auto& triangle = mesh.soup.triangles[mesh.check->parts[i].first_triangle];
    list.push_back(middle_of(mesh.soup, triangle, grid));
  }
  return list;
}

// `until`: how many triangles are drawn of it and all before. `place` is on one of them, if any.
Json objects_of(const ShownMesh& mesh, const PageGrid& grid) {
  const DrawnMesh& drawn = *mesh.drawn;
  Json list = Json::array();
  std::size_t triangles = 0, until = 0;
  for (const ShownObject& object : mesh.objects) {
    triangles += object.triangles;
    const std::size_t before = until;
    while (until < drawn.source.size() && drawn.source[until] < triangles) ++until;
    Json place = nullptr;
    if (until > before) place = middle_of(drawn.soup, drawn.soup.triangles[before], grid);
    list.push_back({{"name", object.name},
                    {"triangles", object.triangles},
                    {"valid_solid", object.is_solid},
                    {"until", until},
                    {"place", place}});
  }
  return list;
}

}  // namespace

void keep_places(SurfaceCheck& check, std::size_t most) {
  for (DefectPlaces& places : check.defects) {
    places.first.resize(std::min(most, places.first.size()));
  }
}

std::vector<PageKind> page_kinds(const std::vector<TriangleKind>& kinds) {
  std::vector<PageKind> list;
  list.reserve(kinds.size());
  for (const TriangleKind& kind : kinds) {
    list.push_back({std::string(kind.name), std::string(kind.meaning), kind.colour});
  }
  return list;
}

Json facts_of(const ShownMesh& mesh, Json section, const PageGrid& grid) {
  const TriangleSoup& soup = mesh.soup;
  MESHREPAIR_ASSERT(mesh.kinds.empty() || mesh.kind_of.size() == soup.triangles.size());
  MESHREPAIR_ASSERT(mesh.drawn.has_value());
  std::size_t not_finite = 0;
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t)
    not_finite += is_finite(soup, t) ? 0 : 1;
  const std::size_t listed = section.is_null() ? 0 : section["first_parts"].size();
  return {{"role", mesh.role},
          {"name", mesh.name},
          {"triangles", soup.triangles.size()},
          {"points", soup.points.size()},
          {"shown", mesh.drawn->soup.triangles.size()},
          {"simplified", mesh.drawn->is_simplified},
          {"has_values", !mesh.drawn->values.empty()},
          {"not_finite", not_finite},
          {"size", sides_of(soup, grid)},
          {"kinds", kinds_of(mesh)},
          {"places", places_of(mesh, grid)},
          {"part_places", part_places(mesh, listed, grid)},
          {"objects", objects_of(mesh, grid)},
          {"check", std::move(section)}};
}

std::vector<std::uint16_t> page_marks(const ShownMesh& mesh) {
  if (!mesh.check) return {};
  std::vector<std::uint16_t> marks = mesh.check->marks;
  if (!mesh.thin) return marks;
  for (std::size_t t = 0; t < marks.size(); ++t) {
    marks[t] = static_cast<std::uint16_t>(marks[t] | mesh.thin->marks[t] << kDefects);
  }
  return marks;
}

Json looks_of_defects(bool has_thin) {
  Json list = Json::array();
  for (const DefectLook& look : defect_looks()) {
    Json bit = nullptr;
    if (look.is_marked) bit = static_cast<int>(look.defect);
    list.push_back({{"key", defect_name(look.defect)},
                    {"words", look.words},
                    {"colour", look.colour},
                    {"bit", bit}});
  }
  if (!has_thin) return list;
  for (const ThinLook& look : thin_looks()) {
    list.push_back({{"key", look.key},
                    {"words", look.meaning},
                    {"colour", look.colour},
                    {"bit", kDefects + static_cast<std::size_t>(look.kind)}});
  }
  return list;
}

}  // namespace meshrepair
