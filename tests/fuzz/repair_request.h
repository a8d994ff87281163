// What fuzz_repair does with its bytes.
#pragma once

#include <array>
#include <cstdint>

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

inline RepairRequest decode_request(FuzzInput& input) {
  RepairRequest request;
  RepairOptions& o = request.options;
  o.inside.rule = static_cast<InsideRule>(input.below(4));
  o.holes.mode = static_cast<HoleMode>(input.below(3));
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
  request.soup = SoupDecoder(input, kMostTriangles).run();
  return request;
}

}  // namespace meshrepair::testing
