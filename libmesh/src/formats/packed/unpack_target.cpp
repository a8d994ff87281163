// SPDX-License-Identifier: MIT
#include "unpack_target.h"

#include <algorithm>

#include <base/error.h>

namespace meshrepair {
namespace {

constexpr std::size_t kLeastRoom = std::size_t{64} << 10;
constexpr std::size_t kMostRoom = std::size_t{1} << 20;

// Some milliseconds of work.
constexpr std::size_t kBytesPerQuestion = std::size_t{1} << 20;

}  // namespace

std::span<char> UnpackTarget::room() {
  const std::size_t size = bytes_.size();
  if (bytes_.capacity() - size < kLeastRoom) {
    bytes_.reserve(std::max(size + kLeastRoom, size + size / 2));
  }
  return {bytes_.data() + size, std::min(bytes_.capacity() - size, kMostRoom)};
}

void UnpackTarget::filled(std::size_t count, std::size_t left) {
  if (!budget_.take(count)) {
    source_.fail("unpacks to more than a file of this size should hold");
  }
  bytes_.resize_for_overwrite(bytes_.size() + count);
  ProgressObserver* const progress = source_.options.progress;
  const std::size_t read = source_.bytes.size() - left;
  if (progress == nullptr || read + bytes_.size() - done_at_question_ < kBytesPerQuestion) return;
  done_at_question_ = read + bytes_.size();
  progress->advance(static_cast<double>(read) / static_cast<double>(source_.bytes.size()));
  if (progress->cancelled()) throw Cancelled();
}

}  // namespace meshrepair
