// SPDX-License-Identifier: MIT
#include "regions.h"

#include <algorithm>
#include <string_view>
#include <unordered_map>

#include <base/ids.h>

namespace meshrepair {

std::size_t used_names(const TriangleLabels& labels) {
  std::vector<char> is_used(labels.names.size(), 0);
  for (const std::uint32_t label : labels.of_triangle) {
    if (label != kNone) is_used[label] = 1;
  }
  return static_cast<std::size_t>(std::count(is_used.begin(), is_used.end(), 1));
}

TriangleLabels regions_of(const Attributes& attributes) {
  const TriangleLabels &groups = attributes.groups, &objects = attributes.objects;
  const bool by_group = objects.empty() || used_names(groups) >= used_names(objects);
  TriangleLabels regions = by_group ? groups : objects;
  const TriangleLabels& other = by_group ? objects : groups;
  if (other.empty()) return regions;
  std::unordered_map<std::string_view, std::uint32_t> number_of;
  std::uint32_t number = 0;
  for (const std::string& name : (by_group ? groups : objects).names) {
    number_of.try_emplace(name, number++);
  }
  for (std::size_t t = 0; t < regions.of_triangle.size(); ++t) {
    const std::uint32_t label = other.of_triangle[t];
    if (regions.of_triangle[t] != kNone || label == kNone) continue;
    const auto fresh = static_cast<std::uint32_t>(regions.names.size());
    const auto [found, is_new] = number_of.try_emplace(other.names[label], fresh);
    if (is_new) regions.names.push_back(other.names[label]);
    regions.of_triangle[t] = found->second;
  }
  return regions;
}

SortedRegions sort_by_region(const TriangleLabels& regions) {
  const std::size_t names = regions.names.size();
  const auto place_of = [&](std::uint32_t label) { return label == kNone ? names : label; };
  SortedRegions sorted;
  sorted.first.assign(names + 2, 0);
  for (const std::uint32_t label : regions.of_triangle) ++sorted.first[place_of(label) + 1];
  for (std::size_t i = 1; i < sorted.first.size(); ++i) sorted.first[i] += sorted.first[i - 1];
  std::vector<std::size_t> next = sorted.first;
  sorted.order.resize(regions.of_triangle.size());
  for (std::size_t t = 0; t < sorted.order.size(); ++t) {
    sorted.order[next[place_of(regions.of_triangle[t])]++] = static_cast<std::uint32_t>(t);
  }
  return sorted;
}

}  // namespace meshrepair
