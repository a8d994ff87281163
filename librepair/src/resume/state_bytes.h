// SPDX-License-Identifier: MIT
// Values as bytes, for the same program to read. What a value of several members is made of is said
// by fields_of(), which gives references to them.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include <base/ids.h>
#include <base/vec3.h>
#include <exact/plane_table.h>

namespace meshrepair::internal {

// T, or T that does not change: so that one fields_of() serves reading and writing.
template <class T, class Of>
concept Is = std::same_as<std::remove_const_t<T>, Of>;

// Its bytes are the value. Eigen's vectors are that, too, but do not say so.
template <class T>
inline constexpr bool kIsBytes = std::is_trivially_copyable_v<T> || std::is_same_v<T, Vec3d>;

class StateWriter {
 public:
  explicit StateWriter(std::ostream& out) : out_(out) {}

  template <class T>
  void operator()(const T& value) {
    if constexpr (kIsBytes<T>) {
      put(&value, 1);
    } else {
      std::apply([this](const auto&... field) { ((*this)(field), ...); }, fields_of(value));
    }
  }
  template <class T>
  void operator()(const std::optional<T>& value) {
    (*this)(value.has_value());
    if (value) (*this)(*value);
  }
  void operator()(const std::string& text) { put_list(text); }
  template <class T>
  void operator()(const std::vector<T>& list) {
    put_list(list);
  }
  template <class Id, class T>
  void operator()(const IdVector<Id, T>& list) {
    put_list(list.raw());
  }
  void operator()(const PlaneTable& planes);

 private:
  template <class T>
  void put(const T* values, std::size_t count) {
    const auto* const bytes = reinterpret_cast<const char*>(values);
    out_.write(bytes, static_cast<std::streamsize>(count * sizeof(T)));
  }
  template <class List>
  void put_list(const List& list) {
    using Value = std::remove_cvref_t<decltype(*list.data())>;
    (*this)(static_cast<std::uint64_t>(list.size()));
    if constexpr (kIsBytes<Value>) {
      put(list.data(), list.size());
    } else {
      for (const Value& value : list) (*this)(value);
    }
  }

  std::ostream& out_;
};

// Of bytes that are cut off or were not written by a StateWriter.
struct BrokenState : std::runtime_error {
  BrokenState() : std::runtime_error("a state ends too soon") {}
};

// `bytes` are those that are there: no list is longer, whatever it says.
class StateReader {
 public:
  StateReader(std::istream& in, std::uint64_t bytes) : in_(in), left_(bytes) {}

  template <class T>
  void operator()(T& value) {
    if constexpr (kIsBytes<T>) {
      take(&value, 1);
    } else {
      std::apply([this](auto&... field) { ((*this)(field), ...); }, fields_of(value));
    }
  }
  template <class T>
  void operator()(std::optional<T>& value) {
    bool has_value = false;
    (*this)(has_value);
    value.reset();
    if (has_value) (*this)(value.emplace());
  }
  void operator()(std::string& text) { take_list(text); }
  template <class T>
  void operator()(std::vector<T>& list) {
    take_list(list);
  }
  template <class Id, class T>
  void operator()(IdVector<Id, T>& list) {
    take_list(list.raw());
  }
  void operator()(PlaneTable& planes);

  [[nodiscard]] bool at_end() const { return left_ == 0; }

 private:
  template <class T>
  void take(T* values, std::size_t count) {
    const std::uint64_t bytes = count * sizeof(T);
    if (bytes > left_) throw BrokenState();
    if (!in_.read(reinterpret_cast<char*>(values), static_cast<std::streamsize>(bytes))) {
      throw BrokenState();
    }
    left_ -= bytes;
  }
  std::size_t take_size(std::size_t bytes_each) {
    std::uint64_t size = 0;
    (*this)(size);
    const auto count = static_cast<std::size_t>(size);
    if (size > left_ / bytes_each || count != size) throw BrokenState();
    return count;
  }
  template <class List>
  void take_list(List& list) {
    using Value = std::remove_cvref_t<decltype(*list.data())>;
    list.resize(take_size(kIsBytes<Value> ? sizeof(Value) : 1));
    if constexpr (kIsBytes<Value>) {
      take(list.data(), list.size());
    } else {
      for (Value& value : list) (*this)(value);
    }
  }

  std::istream& in_;
  std::uint64_t left_;
};

}  // namespace meshrepair::internal
