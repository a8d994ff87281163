// Typed 32-bit ids and vectors that are indexed by them.
//
// An id is a position in one particular array. Making each kind its own type lets the compiler
// refuse a facet where a cell is meant. The invalid id is all ones.
#pragma once

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

template <class Tag>
struct Id {
  static constexpr std::uint32_t kInvalidValue = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t value = kInvalidValue;

  constexpr Id() = default;
  constexpr explicit Id(std::uint32_t position) : value(position) {}
  constexpr explicit Id(std::size_t position) : value(static_cast<std::uint32_t>(position)) {}

  [[nodiscard]] constexpr bool valid() const { return value != kInvalidValue; }
  [[nodiscard]] constexpr std::size_t index() const { return value; }
  constexpr auto operator<=>(const Id&) const = default;  // NOLINT(modernize-use-nullptr)
};

using PlaneId = Id<struct PlaneTag>;
using PointId = Id<struct PointTag>;        // a point of a soup
using TriangleId = Id<struct TriangleTag>;  // a triangle of a soup
using NodeId = Id<struct NodeTag>;          // an inner node of a tree
using LeafId = Id<struct LeafTag>;          // a leaf of a tree

// A vector indexed by one kind of id.
template <class IdType, class Value>
class IdVector {
 public:
  using Storage = std::conditional_t<std::is_trivially_copyable_v<Value>, TrivialVector<Value>,
                                     std::vector<Value>>;

  IdVector() = default;
  explicit IdVector(std::size_t count, const Value& value = Value()) : values_(count, value) {}

  Value& operator[](IdType id) { return values_[id.index()]; }
  const Value& operator[](IdType id) const { return values_[id.index()]; }

  IdType push_back(const Value& value) {
    values_.push_back(value);
    return IdType(values_.size() - 1);
  }

  [[nodiscard]] std::size_t size() const { return values_.size(); }
  [[nodiscard]] bool empty() const { return values_.empty(); }
  [[nodiscard]] IdType end_id() const { return IdType(values_.size()); }
  [[nodiscard]] bool contains(IdType id) const { return id.index() < values_.size(); }
  void assign(std::size_t count, const Value& value) { values_.assign(count, value); }
  void resize(std::size_t count) { values_.resize(count); }
  void reserve(std::size_t count) { values_.reserve(count); }
  void clear() { values_.clear(); }
  [[nodiscard]] const Storage& raw() const { return values_; }
  Storage& raw() { return values_; }

  auto begin() { return values_.begin(); }
  auto end() { return values_.end(); }
  [[nodiscard]] auto begin() const { return values_.begin(); }
  [[nodiscard]] auto end() const { return values_.end(); }

 private:
  Storage values_;
};

}  // namespace meshrepair
