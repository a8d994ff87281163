// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <base/ids.h>
#include <base/parallel.h>
#include <base/roots.h>
#include <mesh/skins.h>
#include <mesh/triangle_paint.h>
#include <repair/transfer_attributes.h>

#include "facing_sources.h"
#include "patch_attributes.h"

namespace meshrepair {
namespace {

using Places = std::array<Vec3d, 3>;

Places places_of(const TriangleSoup& soup, std::size_t t) {
  const std::array<std::uint32_t, 3>& c = soup.triangles[t];
  return {soup.points[c[0]], soup.points[c[1]], soup.points[c[2]]};
}

// How a point is made of the corners of a triangle, in whose plane it lies: seen along the axis
// along which the triangle is largest, as that needs no lengths. What is beside the triangle, as
// points may have been moved, is not far from it. Nothing where it has no area.
std::optional<std::array<double, 3>> shares_of(const Vec3d& p, const Places& triangle) {
  const auto& [a, b, c] = triangle;
  const Vec3d normal = (b - a).cross(c - a);
  Eigen::Index axis = 0;
  const double largest = normal.cwiseAbs().maxCoeff(&axis);
  if (!(largest > 0) || !std::isfinite(largest)) return std::nullopt;
  const Eigen::Index u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto area = [&](const Vec3d& q, const Vec3d& r) {
    return (q[u] - p[u]) * (r[v] - p[v]) - (q[v] - p[v]) * (r[u] - p[u]);
  };
  std::array<double, 3> shares = {area(b, c) / normal[axis], area(c, a) / normal[axis],
                                  area(a, b) / normal[axis]};
  for (double& share : shares) share = std::max(share, 0.0);
  const double sum = shares[0] + shares[1] + shares[2];
  for (double& share : shares) share /= sum;
  return shares;
}

// Values of one kind, of all corners of the result.
class ValueTransfer {
 public:
  ValueTransfer(const TriangleSoup& input, const CornerAttribute& given, const Surface& surface,
                const std::vector<std::uint32_t>& sources, bool has_walls,
                std::span<const CornerOrigin> corners)
      : input_(input),
        given_(given),
        surface_(surface),
        sources_(sources),
        has_walls_(has_walls),
        corners_(corners) {}

  CornerAttribute run() {
    const std::size_t corners = 3 * surface_.mesh.triangles.size();
    CornerAttribute result = given_;
    result.of_corner.assign(corners, kNone);
    std::vector<double> made = make(result.of_corner);
    number(made, result);
    return result;
  }

 private:
  // Of a corner whose value is still to be numbered.
  static constexpr std::uint32_t kMade = kNone - 1;

  // What is no value of the input, in the order of the corners that have kMade then.
  std::vector<double> make(std::vector<std::uint32_t>& of_corner) const {
    constexpr std::size_t kTrianglesPerTask = 4096;
    const auto make_some = [&](std::size_t first, std::size_t last) {
      std::vector<double> made;
      for (std::size_t t = first; t < last; ++t) {
        make_corners(t, std::span(of_corner).subspan(3 * t, 3), made);
      }
      return made;
    };
    return parallel_reduce(surface_.mesh.triangles.size(), kTrianglesPerTask, make_some,
                           [](std::vector<double>& all, const std::vector<double>& some) {
                             all.insert(all.end(), some.begin(), some.end());
                           });
  }

  void make_corners(std::size_t t, std::span<std::uint32_t> of_corner,
                    std::vector<double>& made) const {
    const std::uint32_t source = sources_[t];
    std::fill(of_corner.begin(), of_corner.end(), kNone);
    if (source == Surface::kNoSource) return;
    const Places from = places_of(input_, source), to = places_of(surface_.mesh, t);
    if (has_walls_ && given_.kind == CornerAttribute::Kind::normal && is_steep(from, to)) {
      return make_flat(to, of_corner, made);
    }
    const bool turned = is_turned(from, to);
    const bool is_by_place = !corners_.empty() && given_.place != CornerAttribute::Place::triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      CornerOrigin origin{source, turned, to[k]};
      if (is_by_place && corners_[3 * t + k].source != Surface::kNoSource) {
        origin = corners_[3 * t + k];
      }
      of_corner[k] = value_at(origin, made);
    }
  }

  // kMade: it is appended to `made`.
  std::uint32_t value_at(const CornerOrigin& origin, std::vector<double>& made) const {
    const std::uint32_t* const given = given_.of_corner.data() + 3 * std::size_t{origin.source};
    const bool stays = !turns_ || !origin.turned;
    if (stays && given[0] == given[1] && given[1] == given[2]) return given[0];
    const Places from = places_of(input_, origin.source);
    const Vec3d place = has_walls_ ? on_plane(origin.place, from) : origin.place;
    const auto same =
        static_cast<std::size_t>(std::find(from.begin(), from.end(), place) - from.begin());
    if (same < 3 && stays) return given[same];
    const bool is_full = std::none_of(given, given + 3, [](std::uint32_t v) { return v == kNone; });
    const auto shares = is_full ? shares_of(place, from) : std::nullopt;
    if (!shares) return kNone;
    append_mixed(given, *shares, origin.turned, made);
    return kMade;
  }

  [[nodiscard]] static Vec3d normal_of(const Places& places) {
    return (places[1] - places[0]).cross(places[2] - places[0]);
  }

  [[nodiscard]] static bool is_steep(const Places& from, const Places& to) {
    const Vec3d before = normal_of(from).stableNormalized(), after = normal_of(to);
    return std::abs(before.dot(after)) < 0.5 * std::sqrt(2.0) * stable_length(after);
  }

  // A corner of the triangle itself stays, bit for bit.
  [[nodiscard]] static Vec3d on_plane(const Vec3d& p, const Places& places) {
    if (std::find(places.begin(), places.end(), p) != places.end()) return p;
    const Vec3d normal = normal_of(places).stableNormalized();
    return p - (p - places[0]).dot(normal) * normal;
  }

  static void make_flat(const Places& to, std::span<std::uint32_t> of_corner,
                        std::vector<double>& made) {
    const Vec3d normal = normal_of(to).stableNormalized();
    for (std::uint32_t& value : of_corner) {
      value = kMade;
      made.insert(made.end(), {normal.x(), normal.y(), normal.z()});
    }
  }

  [[nodiscard]] static bool is_turned(const Places& from, const Places& to) {
    return normal_of(from).dot(normal_of(to)) < 0;
  }

  void append_mixed(const std::uint32_t* given, const std::array<double, 3>& shares, bool turned,
                    std::vector<double>& made) const {
    const std::size_t first = made.size();
    if (given_.kind == CornerAttribute::Kind::skin) return append_skin(given, shares, made);
    for (std::size_t i = 0; i < given_.components; ++i) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        sum += shares[k] * given_.values[given_.components * given[k] + i];
      }
      made.push_back(given_.storage == CornerAttribute::Storage::integer ? std::round(sum) : sum);
    }
    if (turns_ && turned && given_.kind != CornerAttribute::Kind::normal) {
      for (std::size_t i = first; i < made.size(); ++i) made[i] = -made[i];
    }
    if (given_.kind != CornerAttribute::Kind::normal) return;
    double squares = 0;
    for (std::size_t i = first; i < made.size(); ++i) squares += made[i] * made[i];
    if (!(squares > 0)) return;
    const double scale = (turned ? -1 : 1) / std::sqrt(squares);
    for (std::size_t i = first; i < made.size(); ++i) made[i] *= scale;
  }

  void append_skin(const std::uint32_t* given, const std::array<double, 3>& shares,
                   std::vector<double>& made) const {
    SkinMixer mixer(given_.components);
    for (std::size_t k = 0; k < 3; ++k) {
      mixer.add(given_.values.data() + given_.components * given[k], shares[k]);
    }
    mixer.append_to(made);
  }

  // Normals, and what is added to them.
  static bool turns(const CornerAttribute& given) {
    const auto target = morph_target_of(given);
    return given.kind == CornerAttribute::Kind::normal || (target && target->semantic == "NORMAL");
  }

  // Appends what was made to the values.
  static void number(const std::vector<double>& made, CornerAttribute& result) {
    auto next = static_cast<std::uint32_t>(result.count());
    result.values.insert(result.values.end(), made.begin(), made.end());
    for (std::uint32_t& value : result.of_corner) {
      if (value == kMade) value = next++;
    }
    share_values(result);
  }

  const TriangleSoup& input_;
  const CornerAttribute& given_;
  const Surface& surface_;
  const std::vector<std::uint32_t>& sources_;
  const bool has_walls_;
  const std::span<const CornerOrigin> corners_;
  const bool turns_ = turns(given_);
};

TriangleLabels transfer_labels(const TriangleLabels& given,
                               const std::vector<std::uint32_t>& sources) {
  if (given.empty()) return {};
  TriangleLabels labels{given.names, {}};
  labels.of_triangle.reserve(sources.size());
  for (const std::uint32_t source : sources) {
    labels.of_triangle.push_back(source == Surface::kNoSource ? kNone : given.of_triangle[source]);
  }
  return labels;
}

// Paint of slicers: whole triangles keep their codes, pieces get new ones.
class PaintTransfer {
 public:
  PaintTransfer(const TriangleSoup& input, const Surface& surface,
                const std::vector<std::uint32_t>& sources)
      : input_(input), surface_(surface), sources_(sources) {}

  [[nodiscard]] TrianglePaint run(const TrianglePaint& given) const {
    TrianglePaint result{given.name, {given.codes.names, {}}};
    std::unordered_map<std::string, std::uint32_t> numbers;
    std::unordered_map<std::uint32_t, PaintCode> codes;  // by their numbers, read once
    for (std::size_t t = 0; t < sources_.size(); ++t) {
      const std::uint32_t source = sources_[t];
      std::uint32_t code = source == Surface::kNoSource ? kNone : given.codes.of_triangle[source];
      if (code != kNone && !is_whole(t, source)) {
        const auto known = codes.try_emplace(code, given.codes.names[code]).first;
        const PaintCode& known_code = known->second;
        if (known_code.is_divided() || !known_code.main_state()) {
          code = number_of(code_of(known->second, t, source), result.codes.names, numbers);
        }
      }
      result.codes.of_triangle.push_back(code);
    }
    return result;
  }

 private:
  [[nodiscard]] bool is_whole(std::size_t t, std::uint32_t source) const {
    return places_of(surface_.mesh, t) == places_of(input_, source);
  }

  [[nodiscard]] std::string code_of(const PaintCode& code, std::size_t t,
                                    std::uint32_t source) const {
    const Places from = places_of(input_, source), to = places_of(surface_.mesh, t);
    std::array<PaintPlace, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto same =
          static_cast<std::size_t>(std::find(from.begin(), from.end(), to[k]) - from.begin());
      if (same < 3) {
        corners[k] = {0, 0, 0};
        corners[k][same] = 1;
        continue;
      }
      const auto shares = shares_of(to[k], from);
      if (!shares) return {};
      corners[k] = *shares;
    }
    return code.within(corners);
  }

  // The names of the input are different ones already; those of pieces come behind.
  static std::uint32_t number_of(const std::string& code, std::vector<std::string>& names,
                                 std::unordered_map<std::string, std::uint32_t>& numbers) {
    if (code.empty()) return kNone;
    const auto [found, is_new] =
        numbers.try_emplace(code, static_cast<std::uint32_t>(names.size()));
    if (is_new) names.push_back(code);
    return found->second;
  }

  const TriangleSoup& input_;
  const Surface& surface_;
  const std::vector<std::uint32_t>& sources_;
};

}  // namespace

Attributes transfer_attributes(const TriangleSoup& input, const Attributes& attributes,
                               const Surface& surface, bool has_walls,
                               std::span<const CornerOrigin> corners) {
  Attributes result;
  const std::vector<std::uint32_t> sources = internal::facing_sources(input, surface);
  for (const CornerAttribute& given : attributes.corners) {
    result.corners.push_back(
        ValueTransfer(input, given, surface, sources, has_walls, corners).run());
  }
  result.materials = transfer_labels(attributes.materials, sources);
  result.looks = attributes.looks;
  result.images = attributes.images;
  result.groups = transfer_labels(attributes.groups, sources);
  result.objects = transfer_labels(attributes.objects, sources);
  result.smoothing = transfer_labels(attributes.smoothing, sources);
  for (const TrianglePaint& paint : attributes.paints) {
    result.paints.push_back(PaintTransfer(input, surface, sources).run(paint));
  }
  result.filaments = attributes.filaments;
  result.keepsake = attributes.keepsake;
  internal::fill_patches(surface, result);
  return result;
}

}  // namespace meshrepair
