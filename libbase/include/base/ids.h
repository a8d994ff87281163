// SPDX-License-Identifier: MIT
// Typed 32-bit ids and vectors that are indexed by them.
//
// An id is a position in one particular array. Making each kind its own type lets the compiler
// refuse a facet where a cell is meant. The invalid id is all ones.
#pragma once

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include <base/trivial_vector.h>

namespace meshrepair {

// An index into an array where there is none.
inline constexpr std::uint32_t kNone = ~std::uint32_t{0};

// How many there may be of a kind, and what they are called where there are more.
template <class Tag>
struct IdKind {
  static constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max();
  static constexpr const char* kName = "elements of one kind";
};

// Throws LimitError.
[[noreturn]] void refuse_ids(std::size_t most, const char* name);

// A position has to fit, as each one in an IdVector does: these do not grow beyond what ids tell.
template <class Tag>
struct Id {
  using Kind = IdKind<Tag>;
  static constexpr std::uint32_t kInvalidValue = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t value = kInvalidValue;

  constexpr Id() = default;
  constexpr explicit Id(std::uint32_t position) : value(position) {}
  constexpr explicit Id(std::size_t position) : value(static_cast<std::uint32_t>(position)) {}

  [[nodiscard]] constexpr bool valid() const { return value != kInvalidValue; }
  [[nodiscard]] constexpr std::size_t index() const { return value; }
  constexpr auto operator<=>(const Id&) const = default;  // NOLINT(modernize-use-nullptr)
};

// Their sides, three to each, are numbered in 32 bits.
template <>
struct IdKind<struct TriangleTag> {
  static constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max() / 3;
  static constexpr const char* kName = "triangles";
};

// An inner node of a tree and a leaf share 32 bits, one of which says what it is.
template <>
struct IdKind<struct NodeTag> {
  static constexpr std::size_t kMost = (std::size_t{1} << 31) - 1;
  static constexpr const char* kName = "nodes of a tree";
};
template <>
struct IdKind<struct LeafTag> {
  static constexpr std::size_t kMost = (std::size_t{1} << 31) - 1;
  static constexpr const char* kName = "leaves of a tree";
};

using PlaneId = Id<struct PlaneTag>;
using PointId = Id<struct PointTag>;        // a point of a soup
using TriangleId = Id<struct TriangleTag>;  // a triangle of a soup
using NodeId = Id<struct NodeTag>;          // an inner node of a tree
using LeafId = Id<struct LeafTag>;          // a leaf of a tree

// Where a list begins that is put behind others, which were put so, too: of how many elements these
// are. Throws LimitError if 32 bits do not tell where all of the list is.
[[nodiscard]] inline std::uint32_t begin_of_list(std::size_t before, std::size_t count) {
  if (count > kNone - std::min<std::size_t>(before, kNone)) refuse_ids(kNone, "elements in lists");
  return static_cast<std::uint32_t>(before);
}

// A vector indexed by one kind of id. Throws LimitError where it would have more than ids tell.
template <class IdType, class Value>
class IdVector {
 public:
  using Storage = std::conditional_t<std::is_trivially_copyable_v<Value>, TrivialVector<Value>,
                                     std::vector<Value>>;

  IdVector() = default;
  explicit IdVector(std::size_t count, const Value& value = Value())
      : values_(checked(count), value) {}

  Value& operator[](IdType id) { return values_[id.index()]; }
  const Value& operator[](IdType id) const { return values_[id.index()]; }

  IdType push_back(const Value& value) {
    if (values_.size() == values_.capacity()) return push_back_and_grow(value);
    values_.push_back(value);
    return IdType(values_.size() - 1);
  }

  [[nodiscard]] std::size_t size() const { return values_.size(); }
  [[nodiscard]] bool empty() const { return values_.empty(); }
  [[nodiscard]] IdType end_id() const { return IdType(values_.size()); }
  [[nodiscard]] bool contains(IdType id) const { return id.index() < values_.size(); }
  void assign(std::size_t count, const Value& value) { values_.assign(checked(count), value); }
  void resize(std::size_t count) {
    if (checked(count) > values_.capacity()) grow(count);
    values_.resize(count);
  }
  void reserve(std::size_t count) { values_.reserve(std::min(count, kMost)); }
  void clear() { values_.clear(); }
  [[nodiscard]] const Storage& raw() const { return values_; }
  Storage& raw() { return values_; }

  auto begin() { return values_.begin(); }
  auto end() { return values_.end(); }
  [[nodiscard]] auto begin() const { return values_.begin(); }
  [[nodiscard]] auto end() const { return values_.end(); }

 private:
  static constexpr std::size_t kMost = IdType::Kind::kMost;

  static std::size_t checked(std::size_t count) {
    if (count > kMost) refuse_ids(kMost, IdType::Kind::kName);
    return count;
  }

  // Never to more than ids tell: so only what grows has to look.
  void grow(std::size_t count) {
    const std::size_t half_more = values_.capacity() + values_.capacity() / 2;
    values_.reserve(std::min(std::max({std::size_t{16}, checked(count), half_more}), kMost));
  }

  IdType push_back_and_grow(const Value& value) {
    const Value copy = value;  // NOLINT(performance-unnecessary-copy-initialization): may be here
    grow(values_.size() + 1);
    values_.push_back(copy);
    return IdType(values_.size() - 1);
  }

  Storage values_;
};

}  // namespace meshrepair
