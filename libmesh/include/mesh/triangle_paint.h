// SPDX-License-Identifier: MIT
// What slicers' brushes leave on triangles: a code of each says how it is divided, and which
// filament, support or seam each piece has.
//
// A code is a text of hexadecimal digits, read from its end. The low two bits of a digit are how
// many sides of the triangle are divided, the others which corner is the first then; or, if none
// is, the state: 0 to 2, or 3 with more digits behind, which are added up as long as they are 15.
// Pieces follow, the last one first. With a, b, c for the corners from the first one on, and ab for
// the middle of a side, they are
//
//   one side:    a b bc, bc c a
//   two sides:   a ab ac, ab b ac, b c ac
//   three sides: a ab ca, ab b bc, bc c ca, ab bc ca
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <mesh/attributes.h>

namespace meshrepair {

namespace internal {
class PaintTree;
}

// Shares of the three corners of the painted triangle.
using PaintPlace = std::array<double, 3>;

// A code that is read once, for all triangles that lie in the painted one.
class PaintCode {
 public:
  explicit PaintCode(std::string_view text);

  // The code of a triangle that lies in the painted one, by its corners: exact where these are the
  // same corners in another order, else down to pieces of a 32nd of its sides. Empty: there is no
  // paint, or the code is none, or divides pieces of pieces more than 24 times.
  [[nodiscard]] std::string within(const std::array<PaintPlace, 3>& corners) const;

  // The state of most of the area; nothing where the code is none.
  [[nodiscard]] std::optional<std::uint32_t> main_state() const;

  // Whether it is a code, and divides the triangle.
  [[nodiscard]] bool is_divided() const;

 private:
  std::shared_ptr<const internal::PaintTree> tree_;  // null: it is no code
};

// For triangles whose second and third corners change places.
void turn_paint(TrianglePaint& paint, std::span<const std::size_t> triangles);

}  // namespace meshrepair
