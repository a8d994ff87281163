// SPDX-License-Identifier: MIT
#include "thin_samples.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include <base/disjoint_sets.h>
#include <base/ids.h>
#include <mesh/weld_points.h>

namespace meshrepair::internal {
namespace {

using Numbers = std::vector<std::uint32_t>;  // of samples

Numbers samples_of(ThinKind kind, const ThinSamples& samples) {
  Numbers numbers;
  for (std::uint32_t s = 0; s < samples.size(); ++s) {
    if (samples[s].kind == kind) numbers.push_back(s);
  }
  return numbers;
}

void join_neighbours(const ThinSamples& samples, const Numbers& numbers, DisjointSets& sets) {
  std::vector<Vec3d> corners;
  corners.reserve(3 * numbers.size());
  for (const std::uint32_t s : numbers) {
    corners.insert(corners.end(), samples[s].corners.begin(), samples[s].corners.end());
  }
  const Numbers place = first_in_place(corners);
  for (std::uint32_t i = 0; i < place.size(); ++i) sets.join(i / 3, place[i] / 3);
}

// What is thin at a sample is so at the piece that stops its ball.
void join_sides(const ThinSamples& samples, const Numbers& numbers,
                std::span<const MeasuredTriangle> triangles, double square, DisjointSets& sets) {
  const auto place = [&](std::uint32_t s) {
    return std::pair(samples[s].triangle, samples[s].path);
  };
  for (std::uint32_t i = 0; i < numbers.size(); ++i) {
    const Contact& contact = samples[numbers[i]].contact;
    const std::pair wanted(contact.triangle,
                           path_to(contact.at, triangles[contact.triangle].corners, square));
    const auto found =
        std::lower_bound(numbers.begin(), numbers.end(), wanted,
                         [&](std::uint32_t s, const auto& key) { return place(s) < key; });
    if (found == numbers.end() || place(*found) != wanted) continue;
    sets.join(i, static_cast<std::uint32_t>(found - numbers.begin()));
  }
}

// The place of samples that are sorted, the thinnest first; nothing if it is too small.
std::optional<ThinPlace> place_of(const ThinSamples& samples, std::span<const std::uint32_t> sorted,
                                  std::span<const MeasuredTriangle> triangles, double least_area) {
  std::optional<ThinPlace> place;
  double area = 0;
  for (const std::uint32_t s : sorted) {
    area += samples[s].area;
    if (place || area < least_area) continue;
    place = {samples[s].at, triangles[samples[s].triangle].id, samples[s].contact.diameter, 0};
  }
  if (place) place->area = area;
  return place;
}

}  // namespace

double sum_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

std::vector<ThinPlace> find_places(ThinKind kind, ThinSamples& samples,
                                   std::span<const MeasuredTriangle> triangles, double square,
                                   double least_area) {
  Numbers numbers = samples_of(kind, samples);
  DisjointSets sets(numbers.size());
  join_neighbours(samples, numbers, sets);
  join_sides(samples, numbers, triangles, square, sets);
  const auto order = [](const ThinSample& sample) {
    return std::tuple(sample.contact.diameter, sample.at.x(), sample.at.y(), sample.at.z(),
                      sample.area);
  };
  Numbers root(samples.size());
  for (std::uint32_t i = 0; i < numbers.size(); ++i) root[numbers[i]] = sets.root(i);
  std::sort(numbers.begin(), numbers.end(), [&](std::uint32_t s, std::uint32_t t) {
    if (root[s] != root[t]) return root[s] < root[t];
    return order(samples[s]) < order(samples[t]);
  });
  std::vector<ThinPlace> places;
  for (auto begin = numbers.begin(); begin != numbers.end();) {
    const auto end = std::find_if(begin, numbers.end(),
                                  [&](std::uint32_t s) { return root[s] != root[*begin]; });
    const std::span<const std::uint32_t> sorted(&*begin, static_cast<std::size_t>(end - begin));
    const auto place = place_of(samples, sorted, triangles, least_area);
    if (place) places.push_back(*place);
    if (!place) std::for_each(begin, end, [&](std::uint32_t s) { samples[s].is_told = false; });
    begin = end;
  }
  std::sort(places.begin(), places.end(), [](const ThinPlace& a, const ThinPlace& b) {
    return std::tuple(a.thickness, a.at.x(), a.at.y(), a.at.z(), a.area) <
           std::tuple(b.thickness, b.at.x(), b.at.y(), b.at.z(), b.area);
  });
  return places;
}

}  // namespace meshrepair::internal
