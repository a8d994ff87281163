// SPDX-License-Identifier: MIT
// Ear clipping.
//
// Idea: go around the polygon; a corner that turns to the left and has no reflex corner in its
// triangle is an ear and is cut off. Two things keep that from being quadratic, without changing
// which ear is next:
// - A tree of boxes over the corners finds a reflex corner in a triangle without looking at all.
// - A corner that is no ear is not tried again before that can have changed. It waits for one of
//   its neighbours to go, and where a reflex corner blocks it, for that one to go or to turn.
//
// Invariant: a corner of the ring that is not a candidate is no ear.
#include "ear_clipper.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <utility>

#include <base/ids.h>

namespace meshrepair::internal {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A set of numbers below a bound, to be gone through in ascending order: a bit for each, a bit for
// each word of those that is not 0, and so on.
class NumberSet {
 public:
  // All numbers below `bound`.
  explicit NumberSet(std::size_t bound) {
    do {
      std::vector<std::uint64_t> level((bound + 63) / 64, ~std::uint64_t{0});
      if (bound % 64 != 0) level.back() >>= 64 - bound % 64;
      bound = level.size();
      levels_.push_back(std::move(level));
    } while (bound > 1);
  }

  void insert(std::uint32_t number) {
    for (auto& level : levels_) {
      level[number / 64] |= bit(number);
      number /= 64;
    }
  }

  void erase(std::uint32_t number) {
    for (auto& level : levels_) {
      level[number / 64] &= ~bit(number);
      if (level[number / 64] != 0) return;
      number /= 64;
    }
  }

  // The smallest from `number` on, else the smallest; kNone if there are none.
  [[nodiscard]] std::uint32_t next_around(std::uint32_t number) const {
    const std::uint32_t found = next(number);
    return found != kNone ? found : next(0);
  }

 private:
  static std::uint64_t bit(std::uint32_t number) { return std::uint64_t{1} << (number % 64); }

  [[nodiscard]] std::uint32_t next(std::uint32_t number) const {
    for (std::size_t l = 0; l < levels_.size() && number / 64 < levels_[l].size(); ++l) {
      const std::uint64_t word = levels_[l][number / 64] >> (number % 64);
      if (word != 0) {
        return first_below(l, number + static_cast<std::uint32_t>(std::countr_zero(word)));
      }
      number = number / 64 + 1;
    }
    return kNone;
  }

  [[nodiscard]] std::uint32_t first_below(std::size_t level, std::uint32_t number) const {
    while (level-- > 0) {
      number = 64 * number + static_cast<std::uint32_t>(std::countr_zero(levels_[level][number]));
    }
    return number;
  }

  std::vector<std::vector<std::uint64_t>> levels_;
};

// A candidate, and a box outside which nothing lies in it.
struct Ear {
  std::array<Flat, 3> corners;
  Flat low, high;
};

// Points, some of them marked; finds a marked one in a triangle. A balanced tree of boxes, node k
// above the nodes 2k and 2k + 1.
class MarkedPoints {
 public:
  explicit MarkedPoints(std::span<const Flat> points)
      : points_(points),
        order_(points.size()),
        leaf_of_(points.size()),
        first_leaf_(std::bit_ceil((points.size() + kInLeaf - 1) / kInLeaf)),
        nodes_(2 * first_leaf_) {
    std::iota(order_.begin(), order_.end(), 0u);
    make(1, 0, order_.size());
  }

  [[nodiscard]] bool is_marked(std::uint32_t point) const { return (leaf_of_[point] & kMark) != 0; }

  void mark(std::uint32_t point, bool marked) {
    if (is_marked(point) == marked) return;
    leaf_of_[point] ^= kMark;
    for (std::size_t k = leaf_of_[point] & ~kMark; k > 0; k /= 2) {
      nodes_[k].marked += marked ? 1u : ~0u;
    }
  }

  // A marked point in the closed triangle, but at none of its corners; kNone if there is none.
  [[nodiscard]] std::uint32_t find_in(const Ear& ear, std::size_t& looked_at) const {
    std::array<std::size_t, 64> stack;
    std::size_t height = 0;
    stack[height++] = 1;
    while (height > 0) {
      const std::size_t k = stack[--height];
      ++looked_at;
      if (nodes_[k].marked == 0 || is_apart(nodes_[k], ear)) continue;
      if (k < first_leaf_) {
        stack[height++] = 2 * k + 1;
        stack[height++] = 2 * k;
        continue;
      }
      for (std::uint32_t i = nodes_[k].begin; i < nodes_[k].end; ++i) {
        ++looked_at;
        if (is_marked(order_[i]) && is_in(points_[order_[i]], ear)) return order_[i];
      }
    }
    return kNone;
  }

 private:
  static constexpr std::size_t kInLeaf = 8;
  static constexpr std::uint32_t kMark = 1u << 31;

  struct Node {
    Flat low, high;
    std::uint32_t begin = 0, end = 0;  // in order_
    std::uint32_t marked = 0;
  };

  void make(std::size_t k, std::size_t begin, std::size_t end) {
    Node& node = nodes_[k];
    node.begin = static_cast<std::uint32_t>(begin);
    node.end = static_cast<std::uint32_t>(end);
    node.low = Flat::Constant(kInfinity);
    node.high = -node.low;
    for (std::size_t i = begin; i < end; ++i) {
      node.low = node.low.cwiseMin(points_[order_[i]]);
      node.high = node.high.cwiseMax(points_[order_[i]]);
    }
    if (k >= first_leaf_) {
      for (std::size_t i = begin; i < end; ++i) {
        leaf_of_[order_[i]] = static_cast<std::uint32_t>(k);
      }
      return;
    }
    const Flat size = node.high - node.low;
    const Eigen::Index axis = size.x() < size.y() ? 1 : 0;
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    const std::size_t middle = begin + (end - begin) / 2;
    std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(points_[a][axis], a) < std::pair(points_[b][axis], b);
    });
    make(2 * k, begin, middle);
    make(2 * k + 1, middle, end);
  }

  // The bridge to a hole passes through the same points twice: those at a corner do not block.
  static bool is_in(const Flat& p, const Ear& ear) {
    const auto& [a, b, c] = ear.corners;
    if (p == a || p == b || p == c) return false;
    return !is_beside(p, p, ear) && left_turn(a, b, p) >= 0 && left_turn(b, c, p) >= 0 &&
           left_turn(c, a, p) >= 0;
  }

  // True only if is_in() is false for each point of the node, rounded as it is. An edge that has
  // all of a box on its right is found at the box's corner that is farthest to its left:
  // left_turn(a, b, p) is monotonic in each coordinate of p, in doubles too, as every single
  // operation is.
  static bool is_apart(const Node& node, const Ear& ear) {
    const auto is_right_of = [&](const Flat& a, const Flat& b) {
      const Flat farthest(b.y() > a.y() ? node.low.x() : node.high.x(),
                          b.x() > a.x() ? node.high.y() : node.low.y());
      return left_turn(a, b, farthest) < 0;
    };
    const auto& [a, b, c] = ear.corners;
    return is_beside(node.low, node.high, ear) || is_right_of(a, b) || is_right_of(b, c) ||
           is_right_of(c, a);
  }

  static bool is_beside(const Flat& low, const Flat& high, const Ear& ear) {
    return low.x() > ear.high.x() || low.y() > ear.high.y() || high.x() < ear.low.x() ||
           high.y() < ear.low.y();
  }

  std::span<const Flat> points_;
  std::vector<std::uint32_t> order_;    // point ids by leaf
  std::vector<std::uint32_t> leaf_of_;  // and the mark
  std::size_t first_leaf_;
  std::vector<Node> nodes_;  // from 1
};

// The polygon that is left, as a ring of positions in `polygon`.
class EarClipper {
 public:
  EarClipper(std::span<const Flat> polygon, EarOrder order)
      : flat_(polygon),
        order_(order),
        next_(polygon.size()),
        previous_(polygon.size()),
        waiting_(polygon.size(), kNone),
        candidates_(polygon.size()),
        reflex_(polygon) {
    const auto count = static_cast<std::uint32_t>(polygon.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      next_[i] = (i + 1) % count;
      previous_[next_[i]] = i;
    }
    for (std::uint32_t i = 0; i < count; ++i) reflex_.mark(i, turns_right(i));
  }

  EarClipping run(std::vector<std::array<std::uint32_t, 3>>& triangles) {
    std::uint32_t corner = 0;
    for (std::size_t left = flat_.size(); left > 3; --left) {
      corner = find_ear(corner);
      if (corner == kNone) return {the_rest(), looked_at_};
      triangles.push_back({previous_[corner], corner, next_[corner]});
      cut_off(corner);
      corner = next_[corner];
      if (order_ == EarOrder::in_rounds) corner = next_[corner];
    }
    triangles.push_back({previous_[corner], corner, next_[corner]});
    return {{}, looked_at_};
  }

 private:
  struct Waiting {
    std::uint32_t corner;
    std::uint32_t next;
  };

  // The first from `corner` on, around the ring.
  std::uint32_t find_ear(std::uint32_t corner) {
    for (corner = candidates_.next_around(corner); corner != kNone;
         corner = candidates_.next_around(corner)) {
      ++looked_at_;
      const Ear ear = ear_at(corner);
      const bool turns_left = left_turn(ear.corners[0], ear.corners[1], ear.corners[2]) > 0;
      // Only reflex corners can lie in an ear without others lying there too.
      const std::uint32_t blocker = turns_left ? reflex_.find_in(ear, looked_at_) : kNone;
      if (turns_left && blocker == kNone) return corner;
      candidates_.erase(corner);
      if (blocker != kNone) wait_for(blocker, corner);
    }
    return kNone;
  }

  [[nodiscard]] Ear ear_at(std::uint32_t corner) const {
    const Flat& a = flat_[previous_[corner]];
    const Flat& b = flat_[corner];
    const Flat& c = flat_[next_[corner]];
    if (order_ == EarOrder::in_rounds)
      return {{a, b, c}, a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
    return {{a, b, c}, Flat::Constant(-kInfinity), Flat::Constant(kInfinity)};
  }

  void wait_for(std::uint32_t blocker, std::uint32_t corner) {
    waiters_.push_back({corner, waiting_[blocker]});
    waiting_[blocker] = static_cast<std::uint32_t>(waiters_.size() - 1);
  }

  void cut_off(std::uint32_t corner) {
    const std::uint32_t before = previous_[corner];
    const std::uint32_t after = next_[corner];
    next_[before] = after;
    previous_[after] = before;
    previous_[corner] = kNone;
    candidates_.erase(corner);
    set_reflex(corner, false);
    for (const std::uint32_t neighbour : {before, after}) {
      candidates_.insert(neighbour);
      set_reflex(neighbour, turns_right(neighbour));
    }
  }

  // Those that waited for a corner which blocks nothing any more may be ears.
  void set_reflex(std::uint32_t corner, bool reflex) {
    reflex_.mark(corner, reflex);
    if (reflex) return;
    for (std::uint32_t w = waiting_[corner]; w != kNone; w = waiters_[w].next) {
      if (is_in_ring(waiters_[w].corner)) candidates_.insert(waiters_[w].corner);
    }
    waiting_[corner] = kNone;
  }

  [[nodiscard]] bool turns_right(std::uint32_t corner) const {
    return left_turn(flat_[previous_[corner]], flat_[corner], flat_[next_[corner]]) <= 0;
  }

  [[nodiscard]] bool is_in_ring(std::uint32_t corner) const { return previous_[corner] != kNone; }

  [[nodiscard]] std::vector<std::uint32_t> the_rest() const {
    std::vector<std::uint32_t> rest;
    for (std::uint32_t i = 0; i < previous_.size(); ++i) {
      if (is_in_ring(i)) rest.push_back(i);
    }
    return rest;
  }

  std::span<const Flat> flat_;
  EarOrder order_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> previous_;  // kNone: cut off
  std::vector<std::uint32_t> waiting_;   // the first of the waiters of each corner
  std::vector<Waiting> waiters_;
  NumberSet candidates_;
  MarkedPoints reflex_;
  std::size_t looked_at_ = 0;
};

}  // namespace

EarClipping clip_ears(std::span<const Flat> polygon, EarOrder order,
                      std::vector<std::array<std::uint32_t, 3>>& triangles) {
  return EarClipper(polygon, order).run(triangles);
}

}  // namespace meshrepair::internal
