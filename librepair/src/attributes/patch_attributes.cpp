// SPDX-License-Identifier: MIT
#include "patch_attributes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include <base/disjoint_sets.h>
#include <base/ids.h>
#include <base/roots.h>
#include <mesh/skins.h>
#include <repair/transfer_attributes.h>

#include "common/continuity.h"

namespace meshrepair::internal {
namespace {

using Kind = CornerAttribute::Kind;

// An edge of a patch, turned as in the patch, and the corners of the triangle beyond it.
struct RimEdge {
  std::uint32_t from, to;
  std::uint32_t corner_at_from = kNone, corner_at_to = kNone;  // kNone: a patch is beyond it

  bool operator<(const RimEdge& other) const {
    return std::pair(from, to) < std::pair(other.from, other.to);
  }
};

struct Patch {
  std::vector<std::uint32_t> triangles;
  std::vector<RimEdge> rim;
};

// Finds the patches: what hangs together by edges.
class PatchFinder {
 public:
  explicit PatchFinder(const Surface& surface) : surface_(surface) {
    for (std::uint32_t t = 0; t < surface.source.size(); ++t) {
      if (surface.source[t] == Surface::kNoSource) triangles_.push_back(t);
    }
  }

  std::vector<Patch> run() {
    std::vector<Patch> patches;
    if (triangles_.empty()) return patches;
    list_edges();
    look_beyond();
    std::vector<std::uint32_t> patch_of(triangles_.size(), kNone);
    DisjointSets joined = join_triangles();
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
      const std::uint32_t root = joined.root(i);
      if (root == i) {
        patch_of[i] = static_cast<std::uint32_t>(patches.size());
        patches.emplace_back();
      }
      patches[patch_of[root]].triangles.push_back(triangles_[i]);
    }
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      if (edges_[e].corner_at_from == kNone) continue;
      patches[patch_of[joined.root(triangle_of_[e])]].rim.push_back(edges_[e]);
    }
    return patches;
  }

 private:
  [[nodiscard]] const std::array<std::uint32_t, 3>& corners(std::uint32_t t) const {
    return surface_.mesh.triangles[t];
  }

  // Of all triangles of patches, in the order of their ends.
  void list_edges() {
    std::vector<std::pair<RimEdge, std::uint32_t>> edges;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
      const auto& c = corners(triangles_[i]);
      for (std::size_t k = 0; k < 3; ++k) edges.push_back({{c[k], c[(k + 1) % 3]}, i});
    }
    std::sort(edges.begin(), edges.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [edge, triangle] : edges) {
      edges_.push_back(edge);
      triangle_of_.push_back(triangle);
    }
  }

  [[nodiscard]] std::size_t find(std::uint32_t from, std::uint32_t to) const {
    const RimEdge wanted{from, to};
    const auto found = std::lower_bound(edges_.begin(), edges_.end(), wanted);
    if (found == edges_.end() || wanted < *found) return edges_.size();
    return static_cast<std::size_t>(found - edges_.begin());
  }

  void look_beyond() {
    std::vector<char> on_patch(surface_.mesh.points.size(), 0);
    for (const RimEdge& edge : edges_) on_patch[edge.from] = 1;
    for (std::uint32_t t = 0; t < surface_.source.size(); ++t) {
      if (surface_.source[t] == Surface::kNoSource) continue;
      const auto& c = corners(t);
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t next = (k + 1) % 3;
        if (on_patch[c[k]] == 0 || on_patch[c[next]] == 0) continue;
        const std::size_t e = find(c[next], c[k]);
        if (e == edges_.size()) continue;
        edges_[e].corner_at_from = 3 * t + next;
        edges_[e].corner_at_to = 3 * t + k;
      }
    }
  }

  DisjointSets join_triangles() {
    DisjointSets joined(triangles_.size());
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const std::size_t back = find(edges_[e].to, edges_[e].from);
      if (back < edges_.size()) joined.join(triangle_of_[e], triangle_of_[back]);
    }
    return joined;
  }

  const Surface& surface_;
  std::vector<std::uint32_t> triangles_;    // of all patches
  std::vector<RimEdge> edges_;              // of these
  std::vector<std::uint32_t> triangle_of_;  // of each edge, among these
};

// Fills in one patch.
class PatchFiller {
 public:
  PatchFiller(const Surface& surface, const Patch& patch, Attributes& attributes)
      : surface_(surface), patch_(patch), attributes_(attributes) {
    for (const std::uint32_t t : patch.triangles) {
      for (const std::uint32_t p : surface.mesh.triangles[t]) points_.try_emplace(p, kNone);
    }
    for (const RimEdge& edge : patch.rim) points_[edge.from] = points_[edge.to] = kOnRim;
    for (auto& [point, place] : points_) {
      if (place == kNone) place = inner_++;
    }
  }

  void run() {
    bool is_chart = true;
    for (CornerAttribute& attribute : attributes_.corners) {
      if (attribute.kind == Kind::normal) {
        set_normals(attribute);
        continue;
      }
      const auto rim = values_of_rim(attribute);
      if (rim && attribute.kind != Kind::tangent) {
        interpolate(*rim, attribute);
      } else if (attribute.kind == Kind::texture) {
        is_chart = false;
      }
    }
    for (TriangleLabels* labels : {&attributes_.groups, &attributes_.objects,
                                   &attributes_.smoothing, &attributes_.materials}) {
      if (labels->empty()) continue;
      const bool is_of_its_own = labels == &attributes_.materials && !is_chart;
      set_label(is_of_its_own ? patch_material() : longest_of_rim(*labels), *labels);
    }
  }

 private:
  static constexpr std::uint32_t kOnRim = kNone - 1;
  using PointValues = std::map<std::uint32_t, std::uint32_t>;

  // Of each point of the rim. Nothing where a point has none; of texture coordinates also where it
  // has several, as there the rim is no one chart.
  [[nodiscard]] std::optional<PointValues> values_of_rim(const CornerAttribute& attribute) const {
    if (patch_.rim.empty()) return std::nullopt;
    PointValues values;
    for (const RimEdge& edge : patch_.rim) {
      for (const auto& [point, corner] :
           {std::pair(edge.from, edge.corner_at_from), std::pair(edge.to, edge.corner_at_to)}) {
        const std::uint32_t value = attribute.of_corner[corner];
        if (value == kNone) return std::nullopt;
        const auto known = values.try_emplace(point, value).first;
        if (known->second != value && attribute.kind == Kind::texture) return std::nullopt;
      }
    }
    return values;
  }

  // Each inner point is the mean of its neighbours.
  void interpolate(const PointValues& rim, CornerAttribute& attribute) {
    const auto first = static_cast<std::uint32_t>(attribute.count());
    if (attribute.kind == Kind::skin) {
      if (inner_ > 0) append_skins(rim, attribute);
    } else {
      append_means(rim, attribute);
    }
    for_each_corner(
        [&](std::uint32_t point, std::uint32_t& value) {
          const std::uint32_t place = points_.at(point);
          value = place == kOnRim ? rim.at(point) : first + place;
        },
        attribute);
  }

  void append_means(const PointValues& rim, CornerAttribute& attribute) const {
    const Eigen::MatrixXd inner = inner_ == 0 ? Eigen::MatrixXd() : solve(rim, attribute);
    const bool is_integer = attribute.storage == CornerAttribute::Storage::integer;
    for (Eigen::Index i = 0; i < inner.rows(); ++i) {
      for (Eigen::Index c = 0; c < inner.cols(); ++c) {
        attribute.values.push_back(is_integer ? std::round(inner(i, c)) : inner(i, c));
      }
    }
  }

  // The weight of each joint by itself, one after the other.
  void append_skins(const PointValues& rim, CornerAttribute& attribute) const {
    Neighbours neighbours;
    list_neighbours(neighbours);
    const std::size_t n = attribute.components;
    std::map<double, std::map<std::uint32_t, double>> joints;  // weights of values
    for (const auto& [point, value] : rim) {
      SkinMixer mixer(n);
      std::vector<double> mixed;
      mixer.add(attribute.values.data() + n * value, 1);
      mixer.append_to(mixed);
      for (std::size_t i = 0; i < n; ++i) {
        const bool is_joint = i % kSkinSet < kSkinSet / 2;
        if (is_joint && mixed[i + kSkinSet / 2] > 0) {
          joints[mixed[i]][value] = mixed[i + kSkinSet / 2];
        }
      }
    }
    std::vector<SkinMixer> mixers(inner_, SkinMixer(n));
    for (const auto& [joint, weights] : joints) {
      Eigen::VectorXd right = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(inner_));
      for (const auto& [row, point] : neighbours.on_rim) {
        const auto weight = weights.find(rim.at(point));
        if (weight != weights.end()) right[row] += weight->second;
      }
      const Eigen::VectorXd inner = neighbours.solver.solve(right);
      for (Eigen::Index i = 0; i < inner.size(); ++i) {
        mixers[static_cast<std::size_t>(i)].add_joint(joint, inner[i]);
      }
    }
    for (SkinMixer& mixer : mixers) mixer.append_to(attribute.values);
  }

  [[nodiscard]] Eigen::MatrixXd solve(const PointValues& rim,
                                      const CornerAttribute& attribute) const {
    const auto components = static_cast<Eigen::Index>(attribute.components);
    Neighbours neighbours;
    list_neighbours(neighbours);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(inner_), components);
    for (const auto& [row, point] : neighbours.on_rim) {
      const std::size_t value = attribute.components * rim.at(point);
      for (Eigen::Index c = 0; c < components; ++c) {
        right(row, c) += attribute.values[value + static_cast<std::size_t>(c)];
      }
    }
    return neighbours.solver.solve(right);
  }

  // The system in which each inner point is the mean of its neighbours, and those on the rim.
  struct Neighbours {
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
    std::vector<std::pair<int, std::uint32_t>> on_rim;  // row and point
  };

  void list_neighbours(Neighbours& found) const {
    const auto inner = static_cast<Eigen::Index>(inner_);
    std::vector<Eigen::Triplet<double>> entries;
    for (const std::uint32_t t : patch_.triangles) {
      const auto& corners = surface_.mesh.triangles[t];
      for (std::size_t k = 0; k < 3; ++k) {
        // Each edge once from either end: the other triangle has it the other way.
        const std::uint32_t neighbour = corners[(k + 1) % 3];
        const std::uint32_t row = points_.at(corners[k]);
        if (row == kOnRim) continue;
        const auto r = static_cast<int>(row);
        entries.emplace_back(r, r, 1);
        const std::uint32_t column = points_.at(neighbour);
        if (column != kOnRim) {
          entries.emplace_back(r, static_cast<int>(column), -1);
        } else {
          found.on_rim.emplace_back(r, neighbour);
        }
      }
    }
    Eigen::SparseMatrix<double> system(inner, inner);
    system.setFromTriplets(entries.begin(), entries.end());
    found.solver.compute(system);
  }

  // Of the patch alone, as it may meet the rest in a crease.
  // A corner looks as the rim does there, where that bends less than a crease; else as those
  // triangles of the patch do that meet there without a crease.
  void set_normals(CornerAttribute& attribute) {
    const std::map<std::uint32_t, std::vector<std::uint32_t>> of_rim = rim_normals(attribute);
    std::map<std::uint32_t, std::vector<Smooth>> smooth;  // of each point
    for (const std::uint32_t t : patch_.triangles) {
      const Vec3d area = area_of(t);
      for (const std::uint32_t p : surface_.mesh.triangles[t])
        smooth_with(area, smooth[p]).sum += area;
    }
    std::map<std::array<double, 3>, std::uint32_t> numbers;
    for (const std::uint32_t t : patch_.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t point = surface_.mesh.triangles[t][k];
        std::uint32_t& value = attribute.of_corner[3 * std::size_t{t} + k];
        const auto rim = of_rim.find(point);
        value = rim == of_rim.end() ? kNone : nearest_of_rim(area_of(t), rim->second, attribute);
        if (value == kNone) {
          value = number_of(smooth_with(area_of(t), smooth[point]).sum, numbers, attribute);
        }
      }
    }
  }

  [[nodiscard]] Vec3d area_of(std::uint32_t t) const {
    const auto& c = surface_.mesh.triangles[t];
    const auto& at = surface_.mesh.points;
    return (at[c[1]] - at[c[0]]).cross(at[c[2]] - at[c[0]]);
  }

  // Of each point of the rim the values beyond it.
  [[nodiscard]] std::map<std::uint32_t, std::vector<std::uint32_t>> rim_normals(
      const CornerAttribute& attribute) const {
    std::map<std::uint32_t, std::vector<std::uint32_t>> values;
    for (const RimEdge& edge : patch_.rim) {
      values[edge.from].push_back(attribute.of_corner[edge.corner_at_from]);
      values[edge.to].push_back(attribute.of_corner[edge.corner_at_to]);
    }
    return values;
  }

  static std::uint32_t nearest_of_rim(const Vec3d& area, const std::vector<std::uint32_t>& values,
                                      const CornerAttribute& attribute) {
    std::uint32_t nearest = kNone;
    double most = kCrease * area.norm();
    for (const std::uint32_t value : values) {
      if (value == kNone) continue;
      const double* const normal = attribute.values.data() + 3 * std::size_t{value};
      const double along = area.dot(Vec3d(normal[0], normal[1], normal[2]));
      if (!(along > most)) continue;
      nearest = value;
      most = along;
    }
    return nearest;
  }

  // Triangles that meet in a point and look as without edges between them: those that bend little
  // from the first of them.
  struct Smooth {
    Vec3d first, sum = Vec3d::Zero();
  };

  static Smooth& smooth_with(const Vec3d& area, std::vector<Smooth>& all) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const Smooth& one) {
      return area.dot(one.first) >= kCrease * area.norm() * one.first.norm();
    });
    return found == all.end() ? all.emplace_back(Smooth{area}) : *found;
  }

  // kNone of what has no direction.
  static std::uint32_t number_of(const Vec3d& normal,
                                 std::map<std::array<double, 3>, std::uint32_t>& numbers,
                                 CornerAttribute& attribute) {
    const double length = stable_length(normal);
    if (!(length > 0) || !std::isfinite(length)) return kNone;
    const std::array<double, 3> unit = {normal.x() / length, normal.y() / length,
                                        normal.z() / length};
    const auto [found, is_new] =
        numbers.try_emplace(unit, static_cast<std::uint32_t>(attribute.count()));
    if (is_new) attribute.values.insert(attribute.values.end(), unit.begin(), unit.end());
    return found->second;
  }

  template <class Visit>
  void for_each_corner(const Visit& visit, CornerAttribute& attribute) const {
    for (const std::uint32_t t : patch_.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        visit(surface_.mesh.triangles[t][k], attribute.of_corner[3 * std::size_t{t} + k]);
      }
    }
  }

  // Of labels along the rim, the one with most of its length; of several the first.
  [[nodiscard]] std::uint32_t longest_of_rim(const TriangleLabels& labels) const {
    std::map<std::uint32_t, double> lengths;
    for (const RimEdge& edge : patch_.rim) {
      lengths[labels.of_triangle[edge.corner_at_from / 3]] +=
          stable_length(surface_.mesh.points[edge.to] - surface_.mesh.points[edge.from]);
    }
    if (lengths.empty()) return kNone;
    return std::max_element(lengths.begin(), lengths.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
  }

  void set_label(std::uint32_t label, TriangleLabels& labels) const {
    for (const std::uint32_t t : patch_.triangles) labels.of_triangle[t] = label;
  }

  std::uint32_t patch_material() {
    std::vector<std::string>& names = attributes_.materials.names;
    const auto known = std::find(names.begin(), names.end(), kPatchMaterial);
    if (known != names.end()) return static_cast<std::uint32_t>(known - names.begin());
    names.emplace_back(kPatchMaterial);
    if (!attributes_.looks.empty()) attributes_.looks.emplace_back();
    return static_cast<std::uint32_t>(names.size() - 1);
  }

  const Surface& surface_;
  const Patch& patch_;
  Attributes& attributes_;
  std::map<std::uint32_t, std::uint32_t> points_;  // kOnRim, or the number among inner ones
  std::uint32_t inner_ = 0;
};

}  // namespace

void fill_patches(const Surface& surface, Attributes& attributes) {
  for (const Patch& patch : PatchFinder(surface).run()) {
    PatchFiller(surface, patch, attributes).run();
  }
}

}  // namespace meshrepair::internal
