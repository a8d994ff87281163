// SPDX-License-Identifier: MIT
// What fuzz_repair does with its bytes.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <repair/repair.h>

#include "fuzz_soup.h"

namespace meshrepair::testing {

inline constexpr std::size_t kMostTriangles = 40;

// What is done to the input that must not change the output.
enum class Change { none, turn_some, copy_some, take_steps };

struct RepairRequest {
  TriangleSoup soup;
  RepairOptions options;
  Change change = Change::none;
  std::uint64_t chosen = 0;  // the triangles that the change is about, as bits
};

// Lengths are shares of the diagonal, from a half down to a millionth.
inline double decode_share(FuzzInput& input) {
  return std::ldexp(1.0, -1 - static_cast<int>(input.below(20)));
}

// All are read, wanted or not, so that bytes keep their places.
inline void decode_wishes(FuzzInput& input, RepairRequest& request) {
  RepairOptions& o = request.options;
  const std::uint8_t wishes = input.byte();
  SewOptions sew;
  sew.mode = static_cast<SewMode>(input.below(3));
  sew.distance = decode_share(input);
  sew.is_share = true;
  SealOptions seal;
  seal.size = decode_share(input);
  seal.is_share = true;
  seal.most_cubes = std::size_t{1} << 12;  // soon done
  ThickenOptions thicken;
  thicken.thickness = decode_share(input);
  thicken.is_share = true;
  thicken.side = static_cast<ThickenSide>(input.below(3));
  KeepPartsOptions keep;
  const std::uint8_t kept = input.byte();
  keep.outer = (kept & 1) != 0;
  keep.fill_voids = (kept & 2) != 0;
  keep.smallest_share = decode_share(input);
  if ((kept & 4) == 0) keep.smallest_share = 0;
  keep.most = kept >> 3 & 3;
  const double simplify = decode_share(input);
  const float opacity = 1.0F / static_cast<float>(1 + input.below(8));
  const std::uint8_t unless_told = input.byte();
  seal.automatic = (unless_told & 49) == 49;  // slow, so seldom
  thicken.automatic = (unless_told & 2) != 0;
  if ((wishes & 1) != 0) o.sew = sew;
  if ((wishes & 2) != 0 && o.predicates == Predicates::exact) o.seal = seal;
  if ((wishes & 4) != 0) o.thicken = thicken;
  if ((wishes & 8) != 0) o.keep = keep;
  if ((wishes & 16) != 0) o.simplify = (unless_told & 4) != 0 ? kDefaultSimplify : simplify;
  if ((wishes & 32) != 0) o.opacity.push_back(opacity);
}

// Some triangles are as sure as all are unless told, others as has been drawn.
inline void spread_opacity(RepairRequest& request) {
  std::vector<float>& opacity = request.options.opacity;
  if (opacity.empty()) return;
  const float drawn = opacity.front();
  opacity.resize(request.soup.triangles.size());
  for (std::size_t t = 0; t < opacity.size(); ++t) {
    opacity[t] = (request.chosen >> t % 64 & 1) != 0 ? drawn : 1.0F;
  }
}

// Where a stage depends on how triangles are turned, on copies, or is no step of its own, nothing
// is changed.
inline bool may_be_changed(const RepairOptions& o) {
  return o.sew.mode == SewMode::none && !o.seal.wanted() && !o.thicken.wanted() &&
         !o.keep.wanted() && o.opacity.empty();
}

// The first byte says also whether there are more options: old inputs have none.
inline RepairRequest decode_request(FuzzInput& input) {
  RepairRequest request;
  RepairOptions& o = request.options;
  o.all_cells = true;
  o.sew.mode = SewMode::none;
  o.simplify = 0;
  const std::uint8_t first = input.byte();
  o.inside.rule = static_cast<InsideRule>(first & 3);
  o.holes.mode = static_cast<HoleMode>(input.below(4));
  const std::uint8_t flags = input.byte();
  o.inside.cavities = (flags & 1) != 0 ? Cavities::fill : Cavities::keep;
  o.extract.touching = (flags & 2) != 0 ? Touching::join : Touching::separate;
  o.certify.precision = (flags & 4) != 0 ? Precision::float32 : Precision::float64;
  o.certify.welded = (flags & 8) != 0;
  o.check_cells = (flags & 112) == 112;  // slow, so seldom
  constexpr std::array kEpsilons = {kDefaultEpsilon, 0.0, 1e-15, 1e-4, 1e-2};
  if ((flags & 128) != 0) o.predicates = Predicates::floating;
  request.change = static_cast<Change>(input.below(4));
  request.chosen = input.number<std::uint16_t>() * std::uint64_t{0x0001000100010001};
  o.epsilon = kEpsilons[request.chosen % kEpsilons.size()];
  if ((first & 4) != 0) decode_wishes(input, request);
  request.soup = SoupDecoder(input, kMostTriangles).run();
  spread_opacity(request);
  if (!may_be_changed(o)) request.change = Change::none;
  return request;
}

}  // namespace meshrepair::testing
