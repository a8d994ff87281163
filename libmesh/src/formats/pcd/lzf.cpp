// SPDX-License-Identifier: MIT
#include "lzf.h"

#include <utility>

namespace meshrepair {
namespace {

class Expander {
 public:
  Expander(std::string_view bytes, std::size_t size) : bytes_(bytes), size_(size) {
    out_.reserve(size);
  }

  bool run() {
    while (at_ < bytes_.size()) {
      const unsigned control = take();
      if (!(control < 32 ? copy_literal(control + 1) : copy_back(control))) return false;
    }
    return out_.size() == size_;
  }

  [[nodiscard]] std::string take_result() { return std::move(out_); }

 private:
  unsigned take() { return static_cast<unsigned char>(bytes_[at_++]); }

  [[nodiscard]] bool fits(std::size_t length) const { return length <= size_ - out_.size(); }

  bool copy_literal(std::size_t length) {
    if (length > bytes_.size() - at_ || !fits(length)) return false;
    out_.append(bytes_.substr(at_, length));
    at_ += length;
    return true;
  }

  bool copy_back(unsigned control) {
    std::size_t length = control >> 5;
    if (at_ + (length == 7 ? 2 : 1) > bytes_.size()) return false;
    if (length == 7) length += take();
    length += 2;
    const std::size_t distance = ((control & 31U) << 8) + take() + 1;
    if (distance > out_.size() || !fits(length)) return false;
    // One by one: what is copied may be longer than what there is, and repeats then.
    for (std::size_t from = out_.size() - distance; length > 0; --length) out_ += out_[from++];
    return true;
  }

  std::string_view bytes_;
  std::size_t size_;
  std::size_t at_ = 0;
  std::string out_;
};

}  // namespace

std::optional<std::string> expand_lzf(std::string_view bytes, std::size_t size) {
  if (size / kMostLzfExpansion > bytes.size()) return std::nullopt;
  Expander expander(bytes, size);
  if (!expander.run()) return std::nullopt;
  return expander.take_result();
}

}  // namespace meshrepair
