// SPDX-License-Identifier: MIT
#include "seams.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <utility>

#include <base/ids.h>
#include <mesh/edge_table.h>
#include <mesh/triangle_paint.h>

#include "common/continuity.h"

namespace meshrepair::internal {
namespace {

using Kind = CornerAttribute::Kind;

// Values of neighbours that are nearer are one, made in two triangles: a share of their extent, a
// pixel of a usual picture.
constexpr double kJump = 1.0 / 1024;

// Values that jump at more than one in so many of the edges are those of faces.
constexpr std::size_t kFewOfEdges = 4;

// Of each triangle, what it belongs to.
std::vector<std::uint32_t> labels_of(const Surface& surface, const Attributes& carried) {
  std::vector<std::uint32_t> labels;
  labels.reserve(surface.source.size());
  for (const std::uint32_t s : surface.source) labels.push_back(s == Surface::kNoSource ? 1 : 0);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> numbers;
  const auto tell_apart = [&](const auto& value_of) {
    numbers.clear();
    for (std::uint32_t t = 0; t < labels.size(); ++t) {
      const auto number = static_cast<std::uint32_t>(numbers.size());
      labels[t] = numbers.try_emplace({labels[t], value_of(t)}, number).first->second;
    }
  };
  for (const TriangleLabels* given :
       {&carried.materials, &carried.groups, &carried.objects, &carried.smoothing}) {
    if (!given->empty()) tell_apart([&](std::uint32_t t) { return given->of_triangle[t]; });
  }
  for (const TrianglePaint& paint : carried.paints) {
    if (paint.codes.empty()) continue;
    std::vector<char> is_divided;
    for (const std::string& code : paint.codes.names) {
      is_divided.push_back(PaintCode(code).is_divided() ? 1 : 0);
    }
    const auto codes = static_cast<std::uint32_t>(paint.codes.names.size());
    tell_apart([&](std::uint32_t t) {
      const std::uint32_t code = paint.codes.of_triangle[t];
      return code != kNone && is_divided[code] != 0 ? codes + t : code;
    });
  }
  return labels;
}

// Whether values at two corners differ by more than a texture's neighbours or a smooth surface do.
class Jumps {
 public:
  explicit Jumps(const CornerAttribute& attribute)
      : attribute_(attribute), jump_(kJump * extent_of(attribute)) {}

  [[nodiscard]] bool operator()(std::uint32_t corner, std::uint32_t other) const {
    const std::uint32_t a = attribute_.of_corner[corner], b = attribute_.of_corner[other];
    if (a == b) return false;
    if (a == kNone || b == kNone) return true;
    const double* const first = attribute_.values.data() + attribute_.components * a;
    const double* const second = attribute_.values.data() + attribute_.components * b;
    if (attribute_.kind == Kind::normal) {
      double dot = 0;
      for (std::size_t i = 0; i < attribute_.components; ++i) dot += first[i] * second[i];
      return dot < kCrease;
    }
    for (std::size_t i = 0; i < attribute_.components; ++i) {
      if (!(std::abs(first[i] - second[i]) <= jump_)) return true;
    }
    return false;
  }

 private:
  const CornerAttribute& attribute_;
  double jump_;
};

using Edges = std::vector<std::array<std::uint32_t, 2>>;  // the two sides of each, 3 t + k

// Of each edge a bit for each end: that of its first side, and the other one.
std::vector<std::uint8_t> jumps_at(const Edges& edges, const CornerAttribute& attribute) {
  const Jumps is_jump(attribute);
  std::vector<std::uint8_t> jumps;
  jumps.reserve(edges.size());
  const auto end_of = [](std::uint32_t side) { return side - side % 3 + (side + 1) % 3; };
  for (const auto& [one, other] : edges) {
    jumps.push_back(static_cast<std::uint8_t>((is_jump(one, end_of(other)) ? 1 : 0) |
                                              (is_jump(end_of(one), other) ? 2 : 0)));
  }
  return jumps;
}

bool may_jump(const CornerAttribute& attribute) {
  return attribute.kind != Kind::skin && attribute.kind != Kind::tangent;
}

}  // namespace

Seams find_seams(const Surface& surface, const Attributes& carried) {
  const auto& triangles = surface.mesh.triangles;
  Edges edges;
  EdgeTable(triangles).for_each_edge([&](std::span<const std::uint32_t> sides) {
    if (sides.size() == 2) edges.push_back({sides[0], sides[1]});
  });
  constexpr std::uint8_t kBoth = 3;
  std::vector<std::uint8_t> ends(edges.size(), 0);  // at which something jumps
  const std::vector<std::uint32_t> labels = labels_of(surface, carried);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (labels[edges[e][0] / 3] != labels[edges[e][1] / 3]) ends[e] = kBoth;
  }
  for (const CornerAttribute& attribute : carried.corners) {
    if (!may_jump(attribute)) continue;
    const std::vector<std::uint8_t> jumps = jumps_at(edges, attribute);
    const auto calm = static_cast<std::size_t>(std::count(jumps.begin(), jumps.end(), 0));
    const bool is_held = attribute.kind == Kind::texture || attribute.kind == Kind::normal;
    if (!is_held && edges.size() - calm > edges.size() / kFewOfEdges) continue;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      ends[e] = static_cast<std::uint8_t>(ends[e] | jumps[e]);
    }
  }
  Seams seams;
  if (std::all_of(ends.begin(), ends.end(), [](std::uint8_t end) { return end == 0; }))
    return seams;
  seams.sides.assign(triangles.size(), 0);
  seams.stays.assign(surface.mesh.points.size(), DecimationOptions::Stay::no);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const std::uint32_t first = edges[e][0];
    if (ends[e] == kBoth) {
      for (const std::uint32_t side : edges[e]) {
        seams.sides[side / 3] = static_cast<std::uint8_t>(seams.sides[side / 3] | 1u << side % 3);
      }
    } else if (ends[e] != 0) {
      const std::uint32_t at = ends[e] == 1 ? first % 3 : (first + 1) % 3;
      seams.stays[triangles[first / 3][at]] = DecimationOptions::Stay::alone;
    }
  }
  return seams;
}

}  // namespace meshrepair::internal
