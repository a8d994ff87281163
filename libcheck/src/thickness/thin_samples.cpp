// SPDX-License-Identifier: MIT
#include "thin_samples.h"

#include <algorithm>
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

bool is_thinner(const ThinPlace& a, const ThinPlace& b) {
  return std::tuple(a.thickness, a.at.x(), a.at.y(), a.at.z(), a.area) <
         std::tuple(b.thickness, b.at.x(), b.at.y(), b.at.z(), b.area);
}

}  // namespace

double sum_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

std::vector<ThinPlace> places_of(ThinKind kind, const ThinSamples& samples,
                                 std::span<const MeasuredTriangle> triangles, double square) {
  const Numbers numbers = samples_of(kind, samples);
  DisjointSets sets(numbers.size());
  join_neighbours(samples, numbers, sets);
  join_sides(samples, numbers, triangles, square, sets);
  std::vector<std::pair<std::uint32_t, double>> areas(numbers.size());  // by root
  std::vector<ThinPlace> of_root(numbers.size());
  for (std::uint32_t i = 0; i < numbers.size(); ++i) {
    const ThinSample& sample = samples[numbers[i]];
    const std::uint32_t root = sets.root(i);
    areas[i] = {root, sample.area};
    const ThinPlace place{sample.at, triangles[sample.triangle].id, sample.contact.diameter, 0};
    if (root == i || is_thinner(place, of_root[root])) of_root[root] = place;
  }
  std::sort(areas.begin(), areas.end());  // so that sums do not depend on the order of samples
  for (const auto& [root, area] : areas) of_root[root].area += area;
  std::vector<ThinPlace> places;
  for (std::uint32_t i = 0; i < numbers.size(); ++i) {
    if (sets.root(i) == i) places.push_back(of_root[i]);
  }
  std::sort(places.begin(), places.end(), is_thinner);
  return places;
}

}  // namespace meshrepair::internal
