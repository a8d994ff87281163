// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include <base/ids.h>
#include <base/roots.h>
#include <mesh/triangle_paint.h>

namespace meshrepair {
namespace internal {

struct PaintNode {
  std::uint32_t sides = 0;  // that are divided
  std::uint32_t first = 0;  // corner
  std::uint32_t state = 0;
  std::array<std::uint32_t, 4> pieces = {0, 0, 0, 0};
};

class PaintTree {
 public:
  explicit PaintTree(std::string_view code) : rest_(code) {
    const std::uint32_t root = read(0);
    is_good_ = root != kNone && rest_.empty();
  }

  [[nodiscard]] bool is_good() const { return is_good_; }
  [[nodiscard]] const PaintNode& operator[](std::uint32_t node) const { return nodes_[node]; }

 private:
  // As far as halves of halves are exact, and no stack ends.
  static constexpr std::size_t kDeepestPaint = 24;

  static std::uint32_t digit_of(char c) {
    if (c >= '0' && c <= '9') return static_cast<std::uint32_t>(c - '0');
    if (c >= 'A' && c <= 'F') return static_cast<std::uint32_t>(c - 'A') + 10;
    if (c >= 'a' && c <= 'f') return static_cast<std::uint32_t>(c - 'a') + 10;
    return kNone;
  }

  std::uint32_t take() {
    if (rest_.empty()) return kNone;
    const std::uint32_t digit = digit_of(rest_.back());
    rest_.remove_suffix(1);
    return digit;
  }

  // Returns its number; kNone: there is none.
  std::uint32_t read(std::size_t depth) {
    const std::uint32_t digit = take();
    if (digit == kNone || depth > kDeepestPaint) return kNone;
    PaintNode node{digit & 3, digit >> 2, digit >> 2, {}};
    const auto number = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back(node);
    if (node.sides == 0) {
      if (node.state == 3 && !add_digits(node.state)) return kNone;
    } else {
      if (node.first == 3) return kNone;
      for (std::uint32_t i = node.sides + 1; i-- > 0;) {
        node.pieces[i] = read(depth + 1);
        if (node.pieces[i] == kNone) return kNone;
      }
    }
    nodes_[number] = node;
    return number;
  }

  bool add_digits(std::uint32_t& state) {
    while (true) {
      const std::uint32_t digit = take();
      if (digit == kNone) return false;
      state += digit;
      if (digit < 15) return true;
    }
  }

  std::string_view rest_;
  std::vector<PaintNode> nodes_;
  bool is_good_ = false;
};

}  // namespace internal

namespace {

using internal::PaintNode;
using internal::PaintTree;

using PaintCorners = std::array<PaintPlace, 3>;

constexpr int kDeepestPiece = 5;
// Two triangles have less in common where they only touch; the sides of the painted one are 1 long.
constexpr double kTouch = 1e-9;
constexpr PaintCorners kWholeTriangle = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

PaintPlace middle(const PaintPlace& a, const PaintPlace& b) {
  return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
}

std::array<PaintCorners, 4> pieces_of(std::uint32_t sides, std::uint32_t first,
                                      const PaintCorners& corners) {
  const PaintPlace &a = corners[first], &b = corners[(first + 1) % 3],
                   &c = corners[(first + 2) % 3];
  const PaintPlace ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
  if (sides == 1) return {{{a, b, bc}, {bc, c, a}, {}, {}}};
  if (sides == 2) return {{{a, ab, ca}, {ab, b, ca}, {b, c, ca}, {}}};
  return {{{a, ab, ca}, {ab, b, bc}, {bc, c, ca}, {ab, bc, ca}}};
}

// Digits in the order in which they are read.
using PaintDigits = std::vector<std::uint8_t>;

PaintDigits state_digits(std::uint32_t state) {
  if (state < 3) return {static_cast<std::uint8_t>(state << 2)};
  PaintDigits digits = {3 << 2};
  for (state -= 3; state >= 15; state -= 15) digits.push_back(15);
  digits.push_back(static_cast<std::uint8_t>(state));
  return digits;
}

PaintDigits split_digits(std::uint32_t sides, std::uint32_t first,
                         const std::array<PaintDigits, 4>& pieces) {
  PaintDigits digits = {static_cast<std::uint8_t>(sides | first << 2)};
  for (std::uint32_t i = sides + 1; i-- > 0;) {
    digits.insert(digits.end(), pieces[i].begin(), pieces[i].end());
  }
  return digits;
}

std::string text_of(const PaintDigits& digits) {
  std::string text;
  if (digits.size() == 1 && digits[0] == 0) return text;
  for (std::size_t i = digits.size(); i-- > 0;) text += "0123456789ABCDEF"[digits[i]];
  return text;
}

bool same_corners(const PaintCorners& a, const PaintCorners& b) {
  return std::all_of(a.begin(), a.end(), [&](const PaintPlace& place) {
    return std::find(b.begin(), b.end(), place) != b.end();
  });
}

std::uint32_t index_of(const PaintPlace& place, const PaintCorners& corners) {
  return static_cast<std::uint32_t>(std::find(corners.begin(), corners.end(), place) -
                                    corners.begin());
}

// The same paint, its triangle's corners in another order.
class PaintReorder {
 public:
  explicit PaintReorder(const PaintTree& tree) : tree_(tree) {}

  [[nodiscard]] PaintDigits run(std::uint32_t number, const PaintCorners& from,
                                const PaintCorners& to) const {
    const PaintNode& node = tree_[number];
    if (node.sides == 0) return state_digits(node.state);
    const Pieces pieces{node, pieces_of(node.sides, node.first, from)};
    std::uint32_t first = node.sides == 3 ? 0 : index_of(from[node.first], to);
    if (node.sides == 2 && to[(first + 1) % 3] != from[(node.first + 1) % 3]) {
      return mirrored_two(pieces, from[(node.first + 1) % 3], to);
    }
    return split(node.sides, first, pieces, to);
  }

 private:
  struct Pieces {
    const PaintNode& node;
    std::array<PaintCorners, 4> corners;
  };

  [[nodiscard]] PaintDigits split(std::uint32_t sides, std::uint32_t first, const Pieces& from,
                                  const PaintCorners& to) const {
    const std::array<PaintCorners, 4> corners = pieces_of(sides, first, to);
    std::array<PaintDigits, 4> digits;
    for (std::uint32_t i = 0; i <= sides; ++i) digits[i] = piece(from, corners[i]);
    return split_digits(sides, first, digits);
  }

  [[nodiscard]] PaintDigits piece(const Pieces& from, const PaintCorners& to) const {
    for (std::uint32_t i = 0; i <= from.node.sides; ++i) {
      if (same_corners(from.corners[i], to)) return run(from.node.pieces[i], from.corners[i], to);
    }
    return state_digits(0);
  }

  // In a mirror the code has no such division, but the side from b to the middle of the other two
  // divides the triangle, and then one half again.
  [[nodiscard]] PaintDigits mirrored_two(const Pieces& from, const PaintPlace& b,
                                         const PaintCorners& to) const {
    const std::uint32_t first = index_of(b, to);
    const std::array<PaintCorners, 4> halves = pieces_of(1, first, to);
    const PaintPlace ca = middle(to[(first + 1) % 3], to[(first + 2) % 3]);
    std::array<PaintDigits, 4> digits;
    for (std::uint32_t i = 0; i < 2; ++i) {
      digits[i] = same_corners(halves[i], from.corners[2])
                      ? piece(from, halves[i])
                      : split(1, index_of(ca, halves[i]), from, halves[i]);
    }
    return split_digits(1, first, digits);
  }

  const PaintTree& tree_;
};

// The paint of a triangle that lies in the painted one.
class PaintResample {
 public:
  explicit PaintResample(const PaintTree& tree) : tree_(tree) {}

  [[nodiscard]] PaintDigits run(const PaintCorners& piece, int depth) const {
    std::optional<std::uint32_t> state;
    if (!is_mixed(0, kWholeTriangle, piece, state)) {
      return state_digits(state ? *state : state_at(piece));
    }
    if (depth == kDeepestPiece) return state_digits(state_at(piece));
    const std::array<PaintCorners, 4> corners = pieces_of(3, 0, piece);
    std::array<PaintDigits, 4> digits;
    for (std::size_t i = 0; i < 4; ++i) digits[i] = run(corners[i], depth + 1);
    const bool is_state = (digits[0][0] & 3) == 0;
    const bool are_same = std::all_of(digits.begin(), digits.end(),
                                      [&](const PaintDigits& one) { return one == digits[0]; });
    return is_state && are_same ? digits[0] : split_digits(3, 0, digits);
  }

 private:
  // Whether `other` lies beyond a side of `triangle`.
  static bool is_beyond(const PaintCorners& triangle, const PaintCorners& other) {
    for (std::size_t k = 0; k < 3; ++k) {
      const PaintPlace &a = triangle[k], &b = triangle[(k + 1) % 3], &c = triangle[(k + 2) % 3];
      const double x = b[1] - a[1], y = b[2] - a[2], length = hypotenuse(x, y);
      const auto side = [&](const PaintPlace& p) { return x * (p[2] - a[2]) - y * (p[1] - a[1]); };
      const double sign = side(c) < 0 ? -1 : 1;
      if (std::all_of(other.begin(), other.end(),
                      [&](const PaintPlace& p) { return sign * side(p) <= kTouch * length; })) {
        return true;
      }
    }
    return false;
  }

  // Whether the piece has more than one state; `state` is the first one.
  [[nodiscard]] bool is_mixed(std::uint32_t number, const PaintCorners& corners,
                              const PaintCorners& piece,
                              std::optional<std::uint32_t>& state) const {
    if (is_beyond(corners, piece) || is_beyond(piece, corners)) return false;
    const PaintNode& node = tree_[number];
    if (node.sides == 0) {
      if (state) return *state != node.state;
      state = node.state;
      return false;
    }
    const std::array<PaintCorners, 4> pieces = pieces_of(node.sides, node.first, corners);
    for (std::uint32_t i = 0; i <= node.sides; ++i) {
      if (is_mixed(node.pieces[i], pieces[i], piece, state)) return true;
    }
    return false;
  }

  // How far inside, in parts of its height.
  static double depth_in(const PaintCorners& triangle, const PaintPlace& p) {
    const auto area = [](const PaintPlace& a, const PaintPlace& b, const PaintPlace& c) {
      return (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]);
    };
    const double all = area(triangle[0], triangle[1], triangle[2]);
    return std::min({area(p, triangle[1], triangle[2]) / all,
                     area(triangle[0], p, triangle[2]) / all,
                     area(triangle[0], triangle[1], p) / all});
  }

  // At its centre.
  [[nodiscard]] std::uint32_t state_at(const PaintCorners& piece) const {
    PaintPlace centre = {0, 0, 0};
    for (const PaintPlace& corner : piece) {
      for (std::size_t k = 0; k < 3; ++k) centre[k] += corner[k] / 3;
    }
    PaintCorners corners = kWholeTriangle;
    std::uint32_t number = 0;
    while (tree_[number].sides > 0) {
      const PaintNode& node = tree_[number];
      const std::array<PaintCorners, 4> pieces = pieces_of(node.sides, node.first, corners);
      std::uint32_t best = 0;
      double deepest = -std::numeric_limits<double>::infinity();
      for (std::uint32_t i = 0; i <= node.sides; ++i) {
        const double depth = depth_in(pieces[i], centre);
        if (depth <= deepest) continue;
        deepest = depth;
        best = i;
      }
      corners = pieces[best];
      number = node.pieces[best];
    }
    return tree_[number].state;
  }

  const PaintTree& tree_;
};

void add_areas(const PaintTree& tree, std::uint32_t number, double area,
               std::map<std::uint32_t, double>& areas) {
  const PaintNode& node = tree[number];
  if (node.sides == 0) {
    areas[node.state] += area;
    return;
  }
  for (std::uint32_t i = 0; i <= node.sides; ++i) {
    const bool is_half = node.sides == 1 || (node.sides == 2 && i == 2);
    add_areas(tree, node.pieces[i], is_half ? area / 2 : area / 4, areas);
  }
}

}  // namespace

PaintCode::PaintCode(std::string_view text) {
  auto tree = std::make_shared<const PaintTree>(text);
  if (tree->is_good()) tree_ = std::move(tree);
}

std::string PaintCode::within(const std::array<PaintPlace, 3>& corners) const {
  if (!tree_) return {};
  if ((*tree_)[0].sides == 0) return text_of(state_digits((*tree_)[0].state));
  return text_of(same_corners(kWholeTriangle, corners)
                     ? PaintReorder(*tree_).run(0, kWholeTriangle, corners)
                     : PaintResample(*tree_).run(corners, 0));
}

std::optional<std::uint32_t> PaintCode::main_state() const {
  if (!tree_) return std::nullopt;
  std::map<std::uint32_t, double> areas;
  add_areas(*tree_, 0, 1, areas);
  // Of equal ones the first.
  return std::max_element(areas.begin(), areas.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

bool PaintCode::is_divided() const { return tree_ && (*tree_)[0].sides > 0; }

void turn_paint(TrianglePaint& paint, std::span<const std::size_t> triangles) {
  TriangleLabels& codes = paint.codes;
  if (codes.empty()) return;
  constexpr PaintCorners kTurned = {{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}};
  std::unordered_map<std::uint32_t, std::uint32_t> turned;
  for (const std::size_t t : triangles) {
    std::uint32_t& code = codes.of_triangle[t];
    if (code == kNone) continue;
    const auto [found, is_new] = turned.try_emplace(code, kNone);
    if (is_new) {
      std::string text = PaintCode(codes.names[code]).within(kTurned);
      if (!text.empty()) {
        found->second = static_cast<std::uint32_t>(codes.names.size());
        codes.names.push_back(std::move(text));
      }
    }
    code = found->second;
  }
}

}  // namespace meshrepair
