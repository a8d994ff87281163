// SPDX-License-Identifier: MIT
#include "joined_solids.h"

#include <map>
#include <utility>

#include "join_soups.h"

namespace meshrepair::internal {
namespace {

// Some of the solids: their soup, and which triangle of it each of their own became.
struct Joined {
  CleanSoup soup;
  std::vector<TriangleId> place;  // of the triangles of all of them, one solid after the other
};

// In halves, so that each triangle is joined a few times only.
Joined join_all(std::vector<CleanSoup>& soups, std::span<const std::uint32_t> source,
                std::size_t first, std::size_t count) {
  if (count == 1) {
    Joined one = {std::move(soups[first]), {}};
    for (TriangleId t(0u); t < one.soup.triangles.end_id(); ++t.value) one.place.push_back(t);
    return one;
  }
  const std::size_t left = count / 2;
  Joined a = join_all(soups, source, first, left);
  const Joined b = join_all(soups, source, first + left, count - left);
  JoinMap map;
  a.soup = join_soups(a.soup, b.soup, source[first + left] - source[first], map);
  for (TriangleId& t : a.place) t = map.first_triangle[t];
  for (const TriangleId t : b.place) a.place.push_back(map.second_triangle[t]);
  return a;
}

}  // namespace

JoinedSolids::JoinedSolids(std::vector<CleanSoup> soups, std::span<const std::size_t> given) {
  std::vector<std::uint32_t> source;
  std::size_t sources = 0;
  first_of_solid_.push_back(0);
  for (std::size_t i = 0; i < soups.size(); ++i) {
    source.push_back(static_cast<std::uint32_t>(sources));
    sources += given[i];
    for (const std::int32_t winding : windings_of(soups[i])) of_solid_.push_back({{}, winding});
    first_of_solid_.push_back(of_solid_.size());
  }
  Joined joined = join_all(soups, source, 0, soups.size());
  soup_ = std::move(joined.soup);
  for (std::size_t i = 0; i < of_solid_.size(); ++i) of_solid_[i].triangle = joined.place[i];
  list_by_triangle();
}

IdVector<TriangleId, std::int32_t> JoinedSolids::windings(std::size_t solid) const {
  IdVector<TriangleId, std::int32_t> winding(soup_.triangles.size(), 0);
  for (std::size_t i = first_of_solid_[solid]; i < first_of_solid_[solid + 1]; ++i) {
    winding[of_solid_[i].triangle] = of_solid_[i].winding;
  }
  return winding;
}

Orientation JoinedSolids::orientation() const {
  Orientation orientation;
  std::map<std::vector<SolidWinding>, std::uint32_t> parts;
  std::vector<SolidWinding> key;
  for (TriangleId t(0u); t < soup_.triangles.end_id(); ++t.value) {
    key.assign(of(t).begin(), of(t).end());
    const auto part = parts.emplace(key, static_cast<std::uint32_t>(parts.size())).first->second;
    orientation.part_of.push_back(part);
  }
  orientation.winding = windings(0);
  return orientation;
}

void JoinedSolids::list_by_triangle() {
  first_.assign(soup_.triangles.size() + 1, 0);
  for (const OfSolid& one : of_solid_) {
    if (one.winding != 0) ++first_[one.triangle.index() + 1];
  }
  for (std::size_t t = 0; t + 1 < first_.size(); ++t) first_[t + 1] += first_[t];
  of_triangle_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t s = 0; s < solids(); ++s) {
    for (std::size_t i = first_of_solid_[s]; i < first_of_solid_[s + 1]; ++i) {
      if (of_solid_[i].winding == 0) continue;
      of_triangle_[next[of_solid_[i].triangle.index()]++] = {static_cast<std::uint32_t>(s),
                                                             of_solid_[i].winding};
    }
  }
}

}  // namespace meshrepair::internal
