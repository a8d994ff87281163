// SPDX-License-Identifier: MIT
#include "volume_ranges.h"

#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <utility>
#include <vector>

namespace meshrepair {
namespace {

// Ids in files are below.
constexpr std::uint32_t kFirstFreeId = std::uint32_t{1} << 31;

struct VolumeRange {
  std::uint32_t volume = kNone;
  std::size_t first = 0, end = 0;  // triangles
};

// Where a triangle of the file is now, or the next one that is there.
std::size_t place_of(const ModelObject& object, std::size_t triangle) {
  const auto bad = std::lower_bound(object.bad.begin(), object.bad.end(), triangle);
  return triangle - static_cast<std::size_t>(bad - object.bad.begin());
}

std::vector<VolumeRange> ranges_of(const ModelObject& object, const ProjectObject& project,
                                   std::size_t& bad) {
  std::vector<VolumeRange> all;
  for (std::uint32_t v = 0; v < project.volumes.size(); ++v) {
    const ProjectVolume& volume = project.volumes[v];
    if (volume.first == kNone && volume.last == kNone) continue;
    all.push_back({v, volume.first, std::size_t{volume.last} + 1});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const VolumeRange& a, const VolumeRange& b) { return a.first < b.first; });
  std::vector<VolumeRange> ranges;
  const std::size_t triangles = object.mesh.triangles.size() + object.bad.size();
  std::size_t end = 0;
  for (const VolumeRange& range : all) {
    if (range.first < end || range.end <= range.first || range.end > triangles) {
      ++bad;
      continue;
    }
    end = range.end;
    ranges.push_back({range.volume, place_of(object, range.first), place_of(object, range.end)});
  }
  return ranges;
}

void add_triangles(const ModelObject& from, std::size_t first, std::size_t end, ModelObject& to) {
  const auto copy = [&](const auto& list, auto& target) {
    if (list.empty()) return;
    target.insert(target.end(), list.begin() + static_cast<std::ptrdiff_t>(first),
                  list.begin() + static_cast<std::ptrdiff_t>(end));
  };
  copy(from.mesh.triangles, to.mesh.triangles);
  copy(from.properties, to.properties);
  copy(from.set_of_triangle, to.set_of_triangle);
}

// Of the sets those that the triangles are in.
void take_sets(const std::vector<TriangleSet>& sets, ModelObject& piece) {
  std::unordered_map<std::uint32_t, std::uint32_t> numbers;
  for (std::uint32_t& set : piece.set_of_triangle) {
    if (set == kNone) continue;
    const auto fresh = static_cast<std::uint32_t>(piece.sets.size());
    const auto [number, is_new] = numbers.try_emplace(set, fresh);
    if (is_new) piece.sets.push_back({sets[set].name, {}});
    set = number->second;
  }
}

// Of the points those that the triangles have, in their order.
void take_points(const std::vector<Vec3d>& points, TriangleSoup& mesh) {
  std::vector<std::uint32_t> used;
  used.reserve(3 * mesh.triangles.size());
  for (const auto& corners : mesh.triangles)
    used.insert(used.end(), corners.begin(), corners.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (const std::uint32_t point : used) mesh.points.push_back(points[point]);
  for (auto& corners : mesh.triangles) {
    for (std::uint32_t& corner : corners) {
      const auto at = std::lower_bound(used.begin(), used.end(), corner);
      corner = static_cast<std::uint32_t>(at - used.begin());
    }
  }
}

}  // namespace

void split_volumes(ModelPart& part, std::uint32_t number, const ProjectObject& project,
                   ModelOddities& oddities) {
  const std::vector<VolumeRange> ranges =
      ranges_of(part.objects[number], project, oddities.bad_ranges);
  if (ranges.empty()) return;
  ModelObject whole = std::move(part.objects[number]);
  std::vector<ModelObject> pieces;
  ModelObject rest;
  std::size_t end = 0;
  for (const VolumeRange& range : ranges) {
    add_triangles(whole, end, range.first, rest);
    end = range.end;
    const ProjectVolume& volume = project.volumes[range.volume];
    ModelObject& piece = pieces.emplace_back();
    piece.role = volume.role;
    piece.name = volume.name;
    piece.volume = range.volume;
    add_triangles(whole, range.first, range.end, piece);
  }
  add_triangles(whole, end, whole.mesh.triangles.size(), rest);
  if (!rest.mesh.triangles.empty()) pieces.push_back(std::move(rest));
  for (ModelObject& piece : pieces) {
    take_points(whole.mesh.points, piece.mesh);
    take_sets(whole.sets, piece);
    piece.property = whole.property;
    piece.id = kFirstFreeId + static_cast<std::uint32_t>(part.objects.size());
    part.object_of_id.emplace(piece.id, static_cast<std::uint32_t>(part.objects.size()));
    whole.components.push_back({0, piece.id, {}, nullptr});
    part.objects.push_back(std::move(piece));
  }
  whole.mesh = {};
  whole.properties = {};
  whole.set_of_triangle = {};
  whole.is_split = true;
  part.objects[number] = std::move(whole);
}

}  // namespace meshrepair
