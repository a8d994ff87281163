// SPDX-License-Identifier: MIT
// Numbers as glTF keeps them: bytes with a layout.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gltf_buffers.h"
#include "gltf_document.h"

namespace meshrepair {

// As accessors number them.
enum class GltfComponent : std::uint32_t {
  int8 = 5120,
  uint8 = 5121,
  int16 = 5122,
  uint16 = 5123,
  uint32 = 5125,
  real32 = 5126,
};

[[nodiscard]] std::size_t size_of(GltfComponent component);

// What an accessor says of its elements.
struct GltfLayout {
  GltfComponent component = GltfComponent::real32;
  bool normalized = false;
  std::size_t components = 1;  // of a matrix all its numbers, column after column
  std::size_t rows = 1;        // columns begin at multiples of four bytes

  [[nodiscard]] std::size_t column_size() const;
  [[nodiscard]] std::size_t size() const { return components / rows * column_size(); }
  [[nodiscard]] std::size_t offset_of(std::size_t component) const;
};

// Reads elements from the bytes that the buffers have, which have to live as long; nothing is
// copied. All elements are known to be within the bytes.
class GltfAccessor {
 public:
  // No elements.
  GltfAccessor() = default;
  // Of the document. Throws InputError if the accessor is broken or reaches beyond its bytes.
  GltfAccessor(const GltfDocument& document, GltfBuffers& buffers, std::size_t number);
  // Elements one after the other in bytes of its own.
  GltfAccessor(const GltfLayout& layout, std::string bytes);

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t components() const { return layout_.components; }
  // Values are shares of 255.
  [[nodiscard]] bool is_byte_share() const {
    return layout_.component == GltfComponent::uint8 && layout_.normalized;
  }
  [[nodiscard]] bool is_index() const;

  // Exact, but for normalized integers.
  [[nodiscard]] double value(std::size_t element, std::size_t component) const;
  // Of integers.
  [[nodiscard]] std::uint32_t index(std::size_t element) const;

  // What the accessor says, without its bytes.
  static GltfLayout layout_of(const GltfDocument& document, const GltfJson& accessor);

 private:
  // Elements that stand elsewhere.
  struct Sparse {
    std::vector<std::uint32_t> elements;  // ascending
    std::string_view values;
  };

  void read_bytes(const GltfDocument& document, GltfBuffers& buffers, const GltfJson& accessor);
  void read_sparse(const GltfDocument& document, GltfBuffers& buffers, const GltfJson& sparse);
  [[nodiscard]] const char* find(std::size_t element) const;

  GltfLayout layout_;
  std::size_t count_ = 0;
  std::size_t stride_ = 0;
  std::string_view bytes_;  // from the first element on; none: all are 0
  std::optional<Sparse> sparse_;
  std::shared_ptr<const std::string> owner_;
};

}  // namespace meshrepair
