// SPDX-License-Identifier: MIT
// Sets of things that can be turned round, of which one knows how they are turned to each other.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace meshrepair::internal {

// Union-find that also says whether a member is turned round against the one that stands for its
// set. Firm members are never turned: where a set has any, one of them stands for it.
class TurnSets {
 public:
  explicit TurnSets(std::vector<char> firm) : firm_(std::move(firm)) {
    links_.reserve(firm_.size());
    for (std::uint32_t m = 0; m < firm_.size(); ++m) links_.push_back({m, false});
  }

  struct Place {
    std::uint32_t root;
    bool turned;
  };

  Place find(std::uint32_t member) {
    bool turned = false;
    std::uint32_t root = member;
    for (; links_[root].root != root; root = links_[root].root) turned ^= links_[root].turned;
    for (bool rest = turned; member != root;) {
      const Place next = std::exchange(links_[member], {root, rest});
      rest ^= next.turned;
      member = next.root;
    }
    return {root, turned};
  }

  // Joins the sets of two members, such that one is turned round against the other if `turn`.
  // Leaves them as they are where that would turn a firm one. Of equals the lower stands for both.
  void join(std::uint32_t a, std::uint32_t b, bool turn) {
    Place to = find(a);
    Place from = find(b);
    if (to.root == from.root) return;
    const bool turned = (to.turned != from.turned) != turn;
    if (firm_[to.root] != 0 && firm_[from.root] != 0 && turned) return;
    if (firm_[to.root] < firm_[from.root] ||
        (firm_[to.root] == firm_[from.root] && from.root < to.root)) {
      std::swap(to, from);
    }
    links_[from.root] = {to.root, turned};
  }

 private:
  std::vector<Place> links_;
  std::vector<char> firm_;
};

}  // namespace meshrepair::internal
