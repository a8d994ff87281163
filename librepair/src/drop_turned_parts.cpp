#include "drop_turned_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

#include <bsp/disjoint_sets.h>
#include <extract/part_orientation.h>

namespace meshrepair::internal {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};

// Brings all coordinates to at most 1, so that no volume overflows, and none of a part that the
// working grid can hold is lost below the smallest number.
class Scale {
 public:
  explicit Scale(const std::vector<Vec3d>& points) {
    double largest = 0;
    for (const Vec3d& p : points) largest = std::max(largest, p.cwiseAbs().maxCoeff());
    (void)std::frexp(largest, &exponent_);
  }

  [[nodiscard]] double operator()(double x) const { return std::ldexp(x, -exponent_); }
  [[nodiscard]] Vec3d operator()(const Vec3d& p) const {
    return {(*this)(p.x()), (*this)(p.y()), (*this)(p.z())};
  }

 private:
  int exponent_ = 0;
};

// Six times the signed volume of each part, scaled, relative to one of its own points, so that
// small parts far from the origin keep their digits. Indexed by the part's root.
std::vector<double> volumes(const TriangleSoup& mesh, const std::vector<Vec3d>& points,
                            const std::vector<std::uint32_t>& part, const Scale& scale) {
  std::vector<double> volume(points.size(), 0);
  for (const auto& t : mesh.triangles) {
    const std::uint32_t root = part[t[0]];
    const Vec3d base = scale(points[root]);
    const Vec3d a = scale(points[t[0]]) - base;
    const Vec3d b = scale(points[t[1]]) - base;
    const Vec3d c = scale(points[t[2]]) - base;
    volume[root] += a.dot(b.cross(c));
  }
  return volume;
}

void remove_parts(Surface& surface, const std::vector<std::uint32_t>& part,
                  const std::vector<char>& drop) {
  TriangleSoup& mesh = surface.mesh;
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (drop[part[mesh.triangles[t][0]]] != 0) continue;
    mesh.triangles[kept] = mesh.triangles[t];
    surface.source[kept++] = surface.source[t];
  }
  mesh.triangles.resize(kept);
  surface.source.resize(kept);
  std::vector<std::uint32_t> place(mesh.points.size(), kNone);
  std::uint32_t points = 0;
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    if (drop[part[p]] != 0) continue;
    place[p] = points;
    mesh.points[points] = mesh.points[p];
    surface.input_point[points++] = surface.input_point[p];
  }
  mesh.points.resize(points);
  surface.input_point.resize(points);
  for (auto& t : mesh.triangles) {
    for (std::uint32_t& p : t) p = place[p];
  }
}

// Of each part: no thicker than this, on average?
std::vector<char> thin_parts(const TriangleSoup& mesh, const PartOrientation& parts,
                             double thickness) {
  struct Size {
    Vec3d base = Vec3d::Zero();
    double area = -1;
    double volume = 0;
  };
  const Scale scale(mesh.points);
  std::vector<Size> sizes(parts.inside_out.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Size& size = sizes[parts.part_of[t]];
    const auto& corners = mesh.triangles[t];
    if (size.area < 0) size = {scale(mesh.points[corners[0]]), 0, 0};
    const Vec3d a = scale(mesh.points[corners[0]]) - size.base;
    const Vec3d b = scale(mesh.points[corners[1]]) - size.base;
    const Vec3d c = scale(mesh.points[corners[2]]) - size.base;
    size.area += 0.5 * (b - a).cross(c - a).norm();
    size.volume += a.dot(b.cross(c)) / 6;
  }
  std::vector<char> thin;
  thin.reserve(sizes.size());
  // A slab has two faces.
  for (const Size& size : sizes) {
    thin.push_back(2 * std::abs(size.volume) <= size.area * scale(thickness) ? 1 : 0);
  }
  return thin;
}

// As drop_inside_out_parts(), without a look at what then is around the others.
InsideOutParts drop_once(Surface& surface, double reach, ProgressObserver* progress) {
  TriangleSoup& mesh = surface.mesh;
  const PartOrientation parts = examine_part_orientation(mesh, progress);
  const auto wrong = std::count(parts.inside_out.begin(), parts.inside_out.end(), 1);
  if (wrong == 0) return {};
  // Both walls may have moved.
  const std::vector<char> thin = thin_parts(mesh, parts, 2 * reach);
  std::vector<char> drop(mesh.points.size(), 0);
  InsideOutParts result;
  for (std::size_t part = 0; part < thin.size(); ++part) {
    if (parts.inside_out[part] != 0) ++(thin[part] != 0 ? result.dropped : result.left);
  }
  const bool nothing_else = result.dropped == thin.size();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (parts.inside_out[parts.part_of[t]] == 0 || thin[parts.part_of[t]] == 0) continue;
    if (nothing_else) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    for (const std::uint32_t p : mesh.triangles[t]) drop[p] = nothing_else ? 0 : 1;
  }
  if (nothing_else) return {};
  std::vector<std::uint32_t> itself(mesh.points.size());
  std::iota(itself.begin(), itself.end(), 0u);
  if (result.dropped > 0) remove_parts(surface, itself, drop);
  return result;
}

}  // namespace

InsideOutParts drop_inside_out_parts(Surface& surface, double reach, ProgressObserver* progress) {
  InsideOutParts all;
  for (;;) {
    const InsideOutParts now = drop_once(surface, reach, progress);
    all.dropped += now.dropped;
    all.left = now.left;
    if (now.dropped == 0) return all;
  }
}

std::size_t drop_turned_parts(Surface& surface, const std::vector<Vec3d>& before) {
  const TriangleSoup& mesh = surface.mesh;
  DisjointSets joined(mesh.points.size());
  for (const auto& t : mesh.triangles) {
    joined.join(t[0], t[1]);
    joined.join(t[0], t[2]);
  }
  std::vector<std::uint32_t> part(mesh.points.size());
  for (std::uint32_t p = 0; p < part.size(); ++p) part[p] = joined.root(p);
  const Scale scale(before);
  const std::vector<double> was = volumes(mesh, before, part, scale);
  const std::vector<double> is = volumes(mesh, mesh.points, part, scale);
  std::vector<char> drop(mesh.points.size(), 0);
  std::size_t dropped = 0;
  std::size_t parts = 0;
  for (std::size_t p = 0; p < part.size(); ++p) {
    if (part[p] != p) continue;
    ++parts;
    if ((was[p] > 0 && is[p] > 0) || (was[p] < 0 && is[p] < 0)) continue;
    drop[p] = 1;
    ++dropped;
  }
  if (dropped == 0 || dropped == parts) return 0;
  remove_parts(surface, part, drop);
  return dropped;
}

}  // namespace meshrepair::internal
