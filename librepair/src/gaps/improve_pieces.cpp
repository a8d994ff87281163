// SPDX-License-Identifier: MIT
#include "improve_pieces.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>

namespace meshrepair::internal {
namespace {

// Nearly all is done in three.
constexpr int kMostFlipPasses = 32;

using Edge = std::array<std::uint32_t, 2>;  // in the direction of its triangle

class Flipper {
 public:
  Flipper(const FlatPoints& at, std::vector<IndexTriangle>& pieces) : at_(at), pieces_(pieces) {
    for (std::uint32_t t = 0; t < pieces_.size(); ++t) put(t);
  }

  bool pass() {
    bool is_changed = false;
    for (std::uint32_t t = 0; t < pieces_.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) is_changed |= flip(t, k);
    }
    return is_changed;
  }

 private:
  void put(std::uint32_t t) {
    for (std::size_t k = 0; k < 3; ++k) of_[{pieces_[t][k], pieces_[t][(k + 1) % 3]}] = t;
  }

  // Twice the area, as a share of the square of the longest side.
  [[nodiscard]] double thickness(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const Flat p = at_(a), q = at_(b), r = at_(c);
    const double squared =
        std::max({(q - p).squaredNorm(), (r - q).squaredNorm(), (p - r).squaredNorm()});
    return squared > 0 ? left_turn(p, q, r) / squared : 0;
  }

  bool flip(std::uint32_t t, std::size_t k) {
    const std::uint32_t a = pieces_[t][k], b = pieces_[t][(k + 1) % 3], c = pieces_[t][(k + 2) % 3];
    const auto across = of_.find({b, a});
    if (across == of_.end()) return false;
    const std::uint32_t other = across->second;
    std::uint32_t d = a;
    for (const std::uint32_t p : pieces_[other]) d = p != a && p != b ? p : d;
    if (d == c || of_.contains({c, d}) || of_.contains({d, c})) return false;
    const double before = std::min(thickness(a, b, c), thickness(b, a, d));
    const double after = std::min(thickness(a, d, c), thickness(d, b, c));
    if (!(after > before)) return false;
    of_.erase(across);
    of_.erase({a, b});
    pieces_[t] = {a, d, c};
    pieces_[other] = {d, b, c};
    put(t);
    put(other);
    return true;
  }

  const FlatPoints& at_;
  std::vector<IndexTriangle>& pieces_;
  std::map<Edge, std::uint32_t> of_;
};

}  // namespace

void improve_pieces(const FlatPoints& at, std::vector<IndexTriangle>& pieces) {
  Flipper flipper(at, pieces);
  for (int pass = 0; pass < kMostFlipPasses && flipper.pass(); ++pass) {
  }
}

}  // namespace meshrepair::internal
