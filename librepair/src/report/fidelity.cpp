// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <base/ids.h>
#include <base/progress.h>
#include <mesh/internal/triangle_measures.h>
#include <mesh/precision.h>
#include <mesh/topology.h>
#include <repair/fidelity.h>

namespace meshrepair {
namespace {

constexpr std::size_t kFewestSamples = 1'000;
constexpr std::size_t kMostSamples = 50'000;

// Sums of areas of pieces are exact to some 1e-13; what lacks a millionth was cut off.
constexpr double kMissingShare = 1e-6;

struct Triangle3d {
  Vec3d a, b, c;
  [[nodiscard]] double area() const { return internal::triangle_area(a, b, c); }
  [[nodiscard]] double perimeter() const {
    return (b - a).norm() + (c - b).norm() + (a - c).norm();
  }
};

Triangle3d triangle_of(const TriangleSoup& mesh, std::size_t t) {
  const auto& corners = mesh.triangles[t];
  return {mesh.points[corners[0]], mesh.points[corners[1]], mesh.points[corners[2]]};
}

// Rounding moves a corner by less than one spacing, and so the outline of all pieces of a triangle,
// which changes their area by less than its perimeter times that.
std::vector<std::uint32_t> find_kept(const TriangleSoup& input, const Surface& surface,
                                     double spacing) {
  std::vector<double> area_out(input.triangles.size(), 0);
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    if (surface.source[t] == Surface::kNoSource) continue;
    area_out[surface.source[t]] += triangle_of(surface.mesh, t).area();
  }
  std::vector<std::uint32_t> kept;
  for (std::uint32_t t = 0; t < input.triangles.size(); ++t) {
    if (!(area_out[t] > 0)) continue;
    const Triangle3d triangle = triangle_of(input, t);
    const double area = triangle.area();
    const double allowed = kMissingShare * area + spacing * triangle.perimeter();
    if (std::abs(area_out[t] - area) <= allowed) kept.push_back(t);
  }
  return kept;
}

// Of each triangle of the input, one of the surface that lies in it; kNone: none does.
std::vector<std::uint32_t> find_pieces(const TriangleSoup& input, const Surface& surface) {
  std::vector<std::uint32_t> piece(input.triangles.size(), kNone);
  for (std::uint32_t t = 0; t < surface.source.size(); ++t) {
    if (surface.source[t] != Surface::kNoSource) piece[surface.source[t]] = t;
  }
  return piece;
}

OneSidedDistance measure(const TriangleSoup& from, const TriangleSoup& to,
                         std::span<const std::uint32_t> twins, ProgressObserver* progress,
                         double begin) {
  ShareOfStage half(progress, begin, begin + 0.5);
  DistanceOptions options;
  options.samples = fidelity_samples(from.triangles.size());
  options.progress = &half;
  options.twins = twins;
  return one_sided_distance(from, to, options);
}

// Bit for bit, and each triangle from the one in its place.
bool is_unchanged(const TriangleSoup& input, const Surface& surface) {
  for (std::uint32_t t = 0; t < surface.source.size(); ++t) {
    if (surface.source[t] != t) return false;
  }
  return surface.mesh.triangles == input.triangles && surface.mesh.points == input.points;
}

}  // namespace

std::size_t fidelity_samples(std::size_t triangles) {
  return std::clamp(triangles, kFewestSamples, kMostSamples);
}

Fidelity measure_fidelity(const TriangleSoup& input, const Surface& surface,
                          const FidelityOptions& options) {
  Fidelity fidelity;
  fidelity.diagonal = bounding_diagonal(input);
  static_assert(Surface::kNoSource == kNone);
  fidelity.output_to_input = measure(surface.mesh, input, surface.source, options.progress, 0);
  if (is_unchanged(input, surface)) {
    fidelity.kept_triangles = input.triangles.size();
    fidelity.kept_area = surface_area(input);
    fidelity.kept_to_output = fidelity.output_to_input;
    if (options.progress != nullptr) options.progress->advance(1);
    return fidelity;
  }
  const std::vector<std::uint32_t> list =
      find_kept(input, surface, internal::number_spacing(surface.mesh, options.precision));
  fidelity.kept_triangles = list.size();
  if (list.empty()) return fidelity;
  const std::vector<std::uint32_t> piece = find_pieces(input, surface);
  TriangleSoup kept;
  kept.points = input.points;
  std::vector<std::uint32_t> twins;
  for (const std::uint32_t t : list) {
    kept.triangles.push_back(input.triangles[t]);
    twins.push_back(piece[t]);
  }
  fidelity.kept_area = surface_area(kept);
  fidelity.kept_to_output = measure(kept, surface.mesh, twins, options.progress, 0.5);
  return fidelity;
}

}  // namespace meshrepair
