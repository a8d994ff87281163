#include "sound_groups.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <check/part_groups.h>

namespace meshrepair::internal {
namespace {

// Of a group's diagonal: points that move do not bring groups together that lie this far apart,
// mostly.
constexpr double kMargin = 1e-3;

// Of each group.
std::vector<char> sound_ones(const PartGroups& groups, std::span<const std::uint32_t> at_fault) {
  std::vector<char> sound(groups.size(), 1);
  for (const std::uint32_t t : at_fault) sound[groups.of_triangle[t]] = 0;
  std::optional<std::size_t> smallest;
  for (std::size_t g = 0; g < sound.size(); ++g) {
    if (sound[g] == 0) continue;
    if (!smallest || groups.triangles[g] < groups.triangles[*smallest]) smallest = g;
  }
  if (smallest) sound[*smallest] = 0;
  return sound;
}

std::vector<char> flags_of_triangles(const PartGroups& groups, const std::vector<char>& of_group) {
  std::vector<char> flags(groups.of_triangle.size());
  std::transform(groups.of_triangle.begin(), groups.of_triangle.end(), flags.begin(),
                 [&](std::uint32_t group) { return of_group[group]; });
  return flags;
}

}  // namespace

void SoundGroups::take_out(Surface& surface, std::span<const std::uint32_t> at_fault) {
  const PartGroups groups = find_groups(surface.mesh, kMargin);
  std::vector<char> sound = sound_ones(groups, at_fault);
  boxes_.clear();
  for (std::size_t g = 0; g < sound.size(); ++g) {
    if (sound[g] != 0) boxes_.push_back(groups.box[g]);
  }
  if (boxes_.empty()) return;
  std::vector<char> goes = flags_of_triangles(groups, sound);
  sound_ = surface;
  keep_triangles(sound_, goes);
  for (char& flag : goes) flag = flag == 0 ? 1 : 0;
  keep_triangles(surface, goes);
}

bool SoundGroups::bring_back(Surface& surface) {
  const PartGroups others = find_groups(surface.mesh, 0);
  const BoxTree tree(boxes_);
  const bool are_apart = std::none_of(others.box.begin(), others.box.end(),
                                      [&](const Box& box) { return meets_any(tree, boxes_, box); });
  append_surface(sound_, surface);
  surface = std::exchange(sound_, {});
  boxes_.clear();
  return are_apart;
}

}  // namespace meshrepair::internal
