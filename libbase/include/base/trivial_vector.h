// SPDX-License-Identifier: MIT
// A growing array of trivially copyable values that is moved by the system's page tables, not by
// copying.
//
// std::vector grows by allocating a second, larger array and copying, which for the pools of a
// large complex doubles the peak memory and touches every page twice. realloc() remaps large blocks
// of the system in place of that.
#pragma once

#include <algorithm>
#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>

#include <base/block_source.h>

namespace meshrepair {

template <class Value>
class TrivialVector {
  static_assert(std::is_trivially_copyable_v<Value>);

 public:
  using value_type = Value;

  TrivialVector() = default;
  explicit TrivialVector(std::size_t count, const Value& value = Value()) { assign(count, value); }
  TrivialVector(const TrivialVector& other) { *this = other; }
  TrivialVector(TrivialVector&& other) noexcept { swap(other); }
  TrivialVector& operator=(const TrivialVector& other) {
    if (this == &other) return *this;
    size_ = 0;
    reserve(other.size_);
    std::copy(other.begin(), other.end(), data_);
    size_ = other.size_;
    return *this;
  }
  TrivialVector& operator=(TrivialVector&& other) noexcept {
    swap(other);
    return *this;
  }
  ~TrivialVector() { free_block(data_); }

  void swap(TrivialVector& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }

  Value& operator[](std::size_t i) { return data_[i]; }
  const Value& operator[](std::size_t i) const { return data_[i]; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t capacity() const { return capacity_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  Value* data() { return data_; }
  [[nodiscard]] const Value* data() const { return data_; }
  Value* begin() { return data_; }
  Value* end() { return data_ + size_; }
  [[nodiscard]] const Value* begin() const { return data_; }
  [[nodiscard]] const Value* end() const { return data_ + size_; }

  void push_back(const Value& value) {
    if (size_ == capacity_) {
      const Value copy = value;  // it may live in this array
      reserve(std::max<std::size_t>(16, capacity_ + capacity_ / 2));
      data_[size_++] = copy;
    } else {
      data_[size_++] = value;
    }
  }
  void resize(std::size_t count) {
    if (count > capacity_) reserve(std::max(count, capacity_ + capacity_ / 2));
    if (count > size_) std::fill(data_ + size_, data_ + count, Value());
    size_ = count;
  }
  // What is new has no value yet.
  void resize_for_overwrite(std::size_t count) {
    reserve(count);
    size_ = count;
  }
  void assign(std::size_t count, const Value& value) {
    const Value copy = value;
    reserve(count);
    std::fill(data_, data_ + count, copy);
    size_ = count;
  }
  void reserve(std::size_t count) {
    if (count <= capacity_) return;
    if (count > static_cast<std::size_t>(-1) / sizeof(Value)) throw std::bad_alloc();
    void* moved =
        resize_block(static_cast<void*>(data_), capacity_ * sizeof(Value), count * sizeof(Value));
    if (moved == nullptr) throw std::bad_alloc();
    data_ = static_cast<Value*>(moved);
    capacity_ = count;
  }
  void clear() { size_ = 0; }

  bool operator==(const TrivialVector& other) const {
    return std::equal(begin(), end(), other.begin(), other.end());
  }

 private:
  Value* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace meshrepair
