// SPDX-License-Identifier: MIT
#include "stl_regions.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <memory>
#include <utility>

#include <base/ids.h>

#include "stl_io.h"

namespace meshrepair {
namespace {

// Words with the top bit are colours of some programs.
constexpr std::uint32_t kRegionLimit = 0x8000;

// Beyond so many, words are what lay in memory, or count triangles.
constexpr std::size_t kMostRegions = 1024;

// 0 where the name is no number that a word can be, as it is written here.
std::uint16_t region_number(const std::string& name) {
  std::uint32_t number = 0;
  const char* const end = name.data() + name.size();
  const auto [last, error] = std::from_chars(name.data(), end, number);
  const bool is_one = error == std::errc() && last == end && name.front() != '0';
  return is_one && number < kRegionLimit ? static_cast<std::uint16_t>(number) : std::uint16_t{0};
}

}  // namespace

void StlSolids::begin(std::string_view name, std::size_t triangle) {
  if (!parts_.empty() && parts_.back().first == triangle) parts_.pop_back();
  parts_.push_back({triangle, number_of(name)});
}

void StlSolids::end(std::string_view name, std::size_t triangle) {
  const bool is_named_late = !parts_.empty() && parts_.back().name == kNone && !name.empty();
  if (is_named_late) parts_.back().name = number_of(name);
  begin({}, triangle);
}

std::uint32_t StlSolids::number_of(std::string_view name) {
  if (name.empty()) return kNone;
  const auto fresh = static_cast<std::uint32_t>(names_.size());
  const auto [found, is_new] = numbers_.try_emplace(std::string(name), fresh);
  if (is_new) names_.emplace_back(name);
  return found->second;
}

void StlSolids::take(std::size_t triangles, Attributes& attributes) {
  while (!parts_.empty() && parts_.back().first == triangles) parts_.pop_back();
  if (parts_.empty()) return;
  if (parts_.front().first > 0) parts_.insert(parts_.begin(), {0, kNone});
  const std::uint32_t name = parts_.front().name;
  const bool is_one = std::all_of(parts_.begin(), parts_.end(),
                                  [&](const Part& part) { return part.name == name; });
  if (is_one && name != kNone) {
    auto kept = std::make_shared<StlSolidName>();
    kept->name = names_[name];
    attributes.keepsake = std::move(kept);
  }
  if (is_one) return;
  attributes.groups.of_triangle.reserve(triangles);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const std::size_t end = i + 1 < parts_.size() ? parts_[i + 1].first : triangles;
    attributes.groups.of_triangle.resize(end, parts_[i].name);
  }
  attributes.groups.names = std::move(names_);
}

TriangleLabels read_stl_regions(std::string_view bytes, std::size_t triangles) {
  TriangleLabels regions;
  std::vector<std::uint32_t> label_of(kRegionLimit, kNone);
  std::vector<std::uint32_t> of_triangle;
  of_triangle.reserve(triangles);
  for (std::size_t t = 0; t < triangles; ++t) {
    std::uint16_t word = 0;
    std::memcpy(&word, bytes.data() + kStlHeaderSize + (t + 1) * kStlTriangleSize - 2, 2);
    if (word >= kRegionLimit) return {};
    if (word > 0 && label_of[word] == kNone) {
      if (regions.names.size() == kMostRegions) return {};
      label_of[word] = static_cast<std::uint32_t>(regions.names.size());
      regions.names.push_back(std::to_string(word));
    }
    of_triangle.push_back(word > 0 ? label_of[word] : kNone);
  }
  const bool is_one = std::all_of(of_triangle.begin(), of_triangle.end(),
                                  [&](std::uint32_t label) { return label == of_triangle[0]; });
  if (is_one) return {};
  regions.of_triangle = std::move(of_triangle);
  return regions;
}

std::vector<std::uint16_t> stl_region_words(const TriangleLabels& groups) {
  std::vector<std::uint16_t> numbers;
  for (const std::string& name : groups.names) numbers.push_back(region_number(name));
  std::vector<std::uint16_t> words;
  words.reserve(groups.of_triangle.size());
  for (const std::uint32_t label : groups.of_triangle) {
    words.push_back(label == kNone ? std::uint16_t{0} : numbers[label]);
    if (label != kNone && words.back() == 0) return {};
  }
  return words;
}

}  // namespace meshrepair
