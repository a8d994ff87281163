// SPDX-License-Identifier: MIT
// Points are spread over the first mesh in proportion to area, one in each of as many equal shares
// of it, and the nearest point of the second is looked up in a tree of its triangles. What is
// random about a point depends on its number alone, and sums are taken in a fixed order, so that
// threads do not matter. What lies on a triangle that both meshes have is not looked up: it is at
// no distance, and around the tip of a cone all boxes are near, so that a look-up takes long.
//
// All of this is done with both meshes scaled by one power of two to about unit size, as squares of
// large and small lengths are beyond doubles. That is exact, and so is the way back.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <span>
#include <string>

#include <Eigen/Geometry>

#include <base/error.h>
#include <base/ids.h>
#include <base/internal/hash_index.h>
#include <base/parallel.h>
#include <base/raw_vector.h>
#include <base/shared_progress.h>
#include <check/internal/nearest_triangle.h>
#include <check/mesh_distance.h>
#include <mesh/mesh_parts.h>

#include "distance_bound.h"

namespace meshrepair {
namespace {

using internal::Corners;
using internal::Nearest;
using internal::NearestTriangle;

constexpr std::size_t kPointsPerTask = 2048;
constexpr std::size_t kMeasuredPerTask = 8192;
constexpr const char* kNothingFinite = ": no triangle has finite coordinates";

// A number in [0, 1) for each seed and position: the mixing function splitmix64 of both.
double random_share(std::uint64_t seed, std::uint64_t position) {
  std::uint64_t x = seed * 0xD1342543DE82EF95u + position * 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  x ^= x >> 31;
  return static_cast<double>(x >> 11) * 0x1p-53;
}

struct FiniteMesh {
  RawVector<Corners> triangles;
  std::vector<std::array<std::uint32_t, 3>> corner_of;  // of each triangle, in `corners`
  std::vector<Vec3d> corners;                           // each point of a triangle once
  std::vector<double> area_up_to;  // of the triangles before and this one, in a unit of its own
  Box box;
  std::size_t not_finite = 0;

  [[nodiscard]] double magnitude() const {
    double most = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      most = std::max({most, std::abs(box.low[k]), std::abs(box.high[k])});
    }
    return most;
  }
};

// By itself: it may be far smaller than another mesh.
double diagonal_of(const Box& box) {
  const Vec3d low(box.low[0], box.low[1], box.low[2]);
  const Vec3d high(box.high[0], box.high[1], box.high[2]);
  const UnitScale scale(std::array{low, high});
  return scale.back((scale(high) - scale(low)).norm());
}

// The triangles' own data, in a mesh without any that are not finite. Areas need a scale of their
// own, as those of a mesh that is far smaller than the other one would be lost.
void measure_triangles(FiniteMesh& mesh) {
  const UnitScale scale(mesh.corners);
  const std::size_t count = mesh.corner_of.size();
  mesh.triangles.resize(count);
  mesh.area_up_to.resize(count);
  const auto measure = [&](std::size_t first, std::size_t last) {
    Box box;
    for (std::size_t t = first; t < last; ++t) {
      Corners& corners = mesh.triangles[t];
      for (std::size_t k = 0; k < 3; ++k) corners[k] = mesh.corners[mesh.corner_of[t][k]];
      for (const Vec3d& p : corners) box.add(p);
      const Vec3d to_b = scale(Vec3d(corners[1] - corners[0]));
      const Vec3d to_c = scale(Vec3d(corners[2] - corners[0]));
      mesh.area_up_to[t] = 0.5 * to_b.cross(to_c).norm();
    }
    return box;
  };
  mesh.box = parallel_reduce(count, kMeasuredPerTask, measure,
                             [](Box& all, const Box& some) { all.add(some); });
  std::partial_sum(mesh.area_up_to.begin(), mesh.area_up_to.end(), mesh.area_up_to.begin());
}

FiniteMesh finite_mesh(const TriangleSoup& soup, const std::string& name) {
  FiniteMesh mesh;
  mesh.corner_of.reserve(soup.triangles.size());
  mesh.corners.reserve(soup.points.size());
  std::vector<std::uint32_t> place(soup.points.size(), kNone);
  for (const auto& t : soup.triangles) {
    const bool is_finite = std::all_of(t.begin(), t.end(),
                                       [&](std::uint32_t p) { return soup.points[p].allFinite(); });
    if (!is_finite) {
      ++mesh.not_finite;
      continue;
    }
    for (const std::uint32_t p : t) {
      if (place[p] != kNone) continue;
      place[p] = static_cast<std::uint32_t>(mesh.corners.size());
      mesh.corners.push_back(soup.points[p]);
    }
    mesh.corner_of.push_back({place[t[0]], place[t[1]], place[t[2]]});
  }
  if (mesh.corner_of.empty()) throw InputError(name + kNothingFinite);
  return mesh;
}

Vec3d largest_coordinates(const FiniteMesh& mesh) {
  Vec3d largest = Vec3d::Zero();
  for (const Vec3d& p : mesh.corners) largest = largest.cwiseMax(p.cwiseAbs());
  return largest;
}

// Scales both alike, and measures them.
UnitScale bring_to_unit(FiniteMesh& a, FiniteMesh& b) {
  const UnitScale scale(std::array{largest_coordinates(a), largest_coordinates(b)});
  for (FiniteMesh* mesh : {&a, &b}) {
    for (Vec3d& p : mesh->corners) p = scale(p);
    measure_triangles(*mesh);
  }
  return scale;
}

OneSidedDistance scaled_back(OneSidedDistance distance, const UnitScale& scale) {
  for (double* length : {&distance.mean, &distance.rms, &distance.largest}) {
    *length = scale.back(*length);
  }
  distance.at = scale.back(distance.at);
  if (distance.bound) distance.bound = scale.back(*distance.bound);
  return distance;
}

// The same whatever the order of the corners.
Corners key(Corners corners) {
  std::sort(corners.begin(), corners.end(), [](const Vec3d& p, const Vec3d& q) {
    return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
  });
  return corners;
}

// Of those that the caller names, the ones that are equal.
std::vector<char> common_triangles(const FiniteMesh& mesh, const FiniteMesh& other,
                                   std::span<const std::uint32_t> twins) {
  std::vector<char> common(mesh.triangles.size(), 0);
  for (std::size_t t = 0; t < common.size(); ++t) {
    if (twins[t] == kNone) continue;
    const Corners &own = mesh.triangles[t], &twin = other.triangles[twins[t]];
    common[t] = own == twin || key(own) == key(twin) ? 1 : 0;
  }
  return common;
}

// Which triangles of a mesh are in another one, too, with the same corners in any order?
std::vector<char> common_triangles(const FiniteMesh& mesh, const FiniteMesh& other) {
  const auto hash = [](const Corners& corners) {
    std::uint64_t sum = 0;
    for (const Vec3d& p : corners) {
      // -0 is 0.
      for (const double x : p) sum = internal::hash_mix(sum, std::bit_cast<std::uint64_t>(x + 0.0));
    }
    return sum;
  };
  internal::HashIndex index(other.triangles.size());
  const auto is_at = [&](const Corners& corners) {
    return [&](std::uint32_t candidate) { return key(other.triangles[candidate]) == corners; };
  };
  for (std::uint32_t t = 0; t < other.triangles.size(); ++t) {
    const Corners corners = key(other.triangles[t]);
    index.find_or_insert(hash(corners), t, is_at(corners));
  }
  std::vector<char> common;
  common.reserve(mesh.triangles.size());
  for (const Corners& t : mesh.triangles) {
    const Corners corners = key(t);
    const std::uint32_t found = index.find(hash(corners), is_at(corners));
    common.push_back(found != internal::HashIndex::kNone ? 1 : 0);
  }
  return common;
}

struct Sample {
  std::size_t triangle;
  Vec3d point;
};

// Sample `i` of `samples`.
Sample sample_point(const FiniteMesh& mesh, std::size_t i, const DistanceOptions& options) {
  const auto random = [&](std::uint64_t k) { return random_share(options.seed, 3 * i + k); };
  const double share = (static_cast<double>(i) + random(0)) / static_cast<double>(options.samples);
  const auto found = std::upper_bound(mesh.area_up_to.begin(), mesh.area_up_to.end(),
                                      share * mesh.area_up_to.back());
  const auto last = static_cast<std::ptrdiff_t>(mesh.triangles.size()) - 1;
  const auto triangle = static_cast<std::size_t>(std::min(found - mesh.area_up_to.begin(), last));
  const Corners& t = mesh.triangles[triangle];
  const double root = std::sqrt(random(1));
  const double to_c = root * random(2);
  return {triangle, (1 - root) * t[0] + (root - to_c) * t[1] + to_c * t[2]};
}

struct Sums {
  double sum = 0;
  double squares = 0;
  double largest = -1;  // squared
  Vec3d at = Vec3d::Zero();

  void note_largest(double squared_distance, const Vec3d& point) {
    if (squared_distance <= largest) return;
    largest = squared_distance;
    at = point;
  }
  void add(const Sums& other) {
    sum += other.sum;
    squares += other.squares;
    note_largest(other.largest, other.at);
  }
};

class OneWay {
 public:
  // `common`: the triangles that `to` has, too.
  OneWay(const FiniteMesh& from, const NearestTriangle& to, const std::vector<char>& common,
         const DistanceOptions& options)
      : from_(from),
        to_(to),
        options_(options),
        common_(common),
        common_corners_(from.corners.size(), 0) {
    for (std::size_t t = 0; t < common.size(); ++t) {
      if (common[t] == 0) continue;
      for (const std::uint32_t p : from.corner_of[t]) common_corners_[p] = 1;
    }
  }

  OneSidedDistance run() const {
    if (options_.progress != nullptr) options_.progress->stage("sample");
    OneSidedDistance distance;
    distance.samples = from_.area_up_to.back() > 0 ? options_.samples : 0;
    const std::size_t points = distance.samples + from_.corners.size();
    SharedProgress progress(options_.progress, tasks_of(points, kPointsPerTask));
    const auto sums_of = [&](std::size_t first, std::size_t last) {
      Sums sums = measure(first, last, distance.samples);
      progress.done();
      return sums;
    };
    const Sums all = parallel_reduce(points, kPointsPerTask, sums_of,
                                     [](Sums& sums, const Sums& part) { sums.add(part); });
    if (distance.samples > 0) {
      distance.mean = all.sum / static_cast<double>(distance.samples);
      distance.rms = std::sqrt(all.squares / static_cast<double>(distance.samples));
    }
    distance.largest = std::sqrt(all.largest);
    distance.at = all.at;
    return distance;
  }

 private:
  // The first points are the samples, the others all corners.
  [[nodiscard]] Sums measure(std::size_t begin, std::size_t end, std::size_t samples) const {
    Sums sums;
    std::uint32_t hint = 0;
    for (std::size_t i = begin; i < end && i < samples; ++i) {
      const Sample sample = sample_point(from_, i, options_);
      const double squared = squared_distance(sample.point, common_[sample.triangle] != 0, hint);
      sums.note_largest(squared, sample.point);
      sums.sum += std::sqrt(squared);
      sums.squares += squared;
    }
    for (std::size_t i = std::max(begin, samples); i < end; ++i) {
      const Vec3d& corner = from_.corners[i - samples];
      const bool is_common = common_corners_[i - samples] != 0;
      sums.note_largest(squared_distance(corner, is_common, hint), corner);
    }
    return sums;
  }

  [[nodiscard]] double squared_distance(const Vec3d& point, bool is_common,
                                        std::uint32_t& hint) const {
    if (is_common) return 0;
    const Nearest nearest = to_.find(point, hint);
    hint = nearest.triangle;
    return nearest.squared_distance;
  }

  const FiniteMesh& from_;
  const NearestTriangle& to_;
  const DistanceOptions& options_;
  const std::vector<char>& common_;
  std::vector<char> common_corners_;
};

void require_sense(const DistanceOptions& options) {
  if (options.samples == 0) throw UsageError("no samples were asked for");
  if (!(options.bound_factor > 1)) throw UsageError("the bound's factor has to be above 1");
}

// All of it is part of the other one.
OneSidedDistance no_distance(const FiniteMesh& from, const DistanceOptions& options) {
  if (options.progress != nullptr) options.progress->stage("sample");
  SharedProgress(options.progress, 1).done();
  OneSidedDistance distance;
  distance.samples = from.area_up_to.back() > 0 ? options.samples : 0;
  distance.at = distance.samples > 0 ? sample_point(from, 0, options).point : from.corners[0];
  return distance;
}

OneSidedDistance distance_between(const FiniteMesh& from, const FiniteMesh& to,
                                  const DistanceOptions& options) {
  const bool is_told =
      options.twins.size() == from.triangles.size() && from.not_finite + to.not_finite == 0;
  const std::vector<char> common =
      is_told ? common_triangles(from, to, options.twins) : common_triangles(from, to);
  const bool all = std::find(common.begin(), common.end(), 0) == common.end();
  if (all && !options.bound) return no_distance(from, options);
  const NearestTriangle nearest(to.triangles);
  OneSidedDistance distance = OneWay(from, nearest, common, options).run();
  if (!options.bound) return distance;
  if (options.progress != nullptr) options.progress->stage("bound");
  const internal::BoundOptions bound = {options.bound_factor, options.most_pieces, distance.largest,
                                        std::max(from.magnitude(), to.magnitude()),
                                        options.progress};
  distance.bound = internal::distance_bound(from.triangles, nearest, bound);
  return distance;
}

}  // namespace

double MeshDistance::largest() const { return std::max(forth.largest, back.largest); }

std::optional<double> MeshDistance::bound() const {
  if (!forth.bound || !back.bound) return std::nullopt;
  return std::max(*forth.bound, *back.bound);
}

MeshDistance mesh_distance(const TriangleSoup& first, const TriangleSoup& second,
                           const DistanceOptions& options) {
  require_sense(options);
  FiniteMesh a = finite_mesh(first, "A");
  FiniteMesh b = finite_mesh(second, "B");
  const UnitScale scale = bring_to_unit(a, b);
  MeshDistance distance;
  distance.forth = scaled_back(distance_between(a, b, options), scale);
  distance.back = scaled_back(distance_between(b, a, options), scale);
  distance.diagonal = scale.back(diagonal_of(a.box));
  distance.not_finite = a.not_finite + b.not_finite;
  return distance;
}

OneSidedDistance one_sided_distance(const TriangleSoup& from, const TriangleSoup& to,
                                    const DistanceOptions& options) {
  require_sense(options);
  FiniteMesh a = finite_mesh(from, "A");
  FiniteMesh b = finite_mesh(to, "B");
  const UnitScale scale = bring_to_unit(a, b);
  return scaled_back(distance_between(a, b, options), scale);
}

std::vector<std::uint32_t> triangles_beyond(const TriangleSoup& from, const TriangleSoup& to,
                                            double distance, ProgressObserver* progress) {
  FiniteMesh a = finite_mesh(from, "A");
  FiniteMesh b = finite_mesh(to, "B");
  const UnitScale scale = bring_to_unit(a, b);
  const NearestTriangle nearest(b.triangles);
  const std::vector<char> beyond = internal::are_beyond(
      a.triangles, nearest, scale(distance), std::max(a.magnitude(), b.magnitude()), progress);
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t t = 0; t < beyond.size(); ++t) {
    if (beyond[t] != 0) triangles.push_back(t);
  }
  return triangles;
}

double bounding_diagonal(const TriangleSoup& soup) {
  Box all;
  for (const auto& t : soup.triangles) {
    Box box;
    for (const std::uint32_t p : t) box.add(soup.points[p]);
    const bool is_finite = std::all_of(t.begin(), t.end(),
                                       [&](std::uint32_t p) { return soup.points[p].allFinite(); });
    if (is_finite) all.add(box);
  }
  if (all.low[0] > all.high[0]) throw InputError(std::string("A") + kNothingFinite);
  return diagonal_of(all);
}

}  // namespace meshrepair
