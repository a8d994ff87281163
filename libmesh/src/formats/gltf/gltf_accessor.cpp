// SPDX-License-Identifier: MIT
#include "gltf_accessor.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace meshrepair {
namespace {

template <class Number>
Number number_at(const char* at) {
  Number value{};
  std::memcpy(&value, at, sizeof value);
  return value;
}

template <class Integer>
double integer_at(const char* at, bool normalized) {
  const auto value = static_cast<double>(number_at<Integer>(at));
  if (!normalized) return value;
  return std::max(value / static_cast<double>(std::numeric_limits<Integer>::max()), -1.0);
}

std::optional<GltfComponent> component_of(std::size_t number) {
  switch (number) {
    case 5120:
    case 5121:
    case 5122:
    case 5123:
    case 5125:
    case 5126:
      return static_cast<GltfComponent>(number);
    default:
      return std::nullopt;
  }
}

struct AccessorShape {
  std::string_view name;
  std::size_t components, rows;
};

constexpr std::array<AccessorShape, 7> kShapes = {{{"SCALAR", 1, 1},
                                                   {"VEC2", 2, 2},
                                                   {"VEC3", 3, 3},
                                                   {"VEC4", 4, 4},
                                                   {"MAT2", 4, 2},
                                                   {"MAT3", 9, 3},
                                                   {"MAT4", 16, 4}}};

// Whether `count` elements of this size, `stride` apart, lie within so many bytes.
bool fit(std::size_t count, std::size_t stride, std::size_t size, std::size_t bytes) {
  return count == 0 || (size <= bytes && (count - 1) <= (bytes - size) / stride);
}

}  // namespace

std::size_t size_of(GltfComponent component) {
  switch (component) {
    case GltfComponent::int8:
    case GltfComponent::uint8:
      return 1;
    case GltfComponent::int16:
    case GltfComponent::uint16:
      return 2;
    case GltfComponent::uint32:
    case GltfComponent::real32:
      break;
  }
  return 4;
}

std::size_t GltfLayout::column_size() const {
  const std::size_t bytes = rows * size_of(component);
  return rows == components ? bytes : (bytes + 3) / 4 * 4;
}

std::size_t GltfLayout::offset_of(std::size_t number) const {
  return number / rows * column_size() + number % rows * size_of(component);
}

GltfLayout GltfAccessor::layout_of(const GltfDocument& document, const GltfJson& accessor) {
  GltfLayout layout;
  const auto component = component_of(document.required_whole(accessor, "componentType"));
  const std::string type = gltf_text(accessor, "type");
  const auto* const shape = std::find_if(kShapes.begin(), kShapes.end(),
                                         [&](const auto& known) { return known.name == type; });
  if (!component || shape == kShapes.end()) {
    document.source().fail("an accessor has a type that glTF does not know");
  }
  layout.component = *component;
  layout.components = shape->components;
  layout.rows = shape->rows;
  const GltfJson* const normalized = gltf_member(accessor, "normalized");
  layout.normalized = normalized != nullptr && normalized->is_boolean() && normalized->get<bool>();
  return layout;
}

GltfAccessor::GltfAccessor(const GltfDocument& document, GltfBuffers& buffers, std::size_t number) {
  const GltfJson& accessor = document.entry("accessors", number);
  layout_ = layout_of(document, accessor);
  count_ = document.required_whole(accessor, "count");
  read_bytes(document, buffers, accessor);
  const GltfJson* const sparse = gltf_member(accessor, "sparse");
  if (sparse != nullptr) read_sparse(document, buffers, *sparse);
}

GltfAccessor::GltfAccessor(const GltfLayout& layout, std::string bytes)
    : layout_(layout),
      count_(bytes.size() / layout.size()),
      stride_(layout.size()),
      owner_(std::make_shared<const std::string>(std::move(bytes))) {
  bytes_ = *owner_;
}

void GltfAccessor::read_bytes(const GltfDocument& document, GltfBuffers& buffers,
                              const GltfJson& accessor) {
  const std::optional<std::size_t> view = document.whole(accessor, "bufferView");
  const std::string what = "an accessor of " + counted(count_, "element");
  if (!view) {
    // All are 0. Whoever asks for more than the file has bytes wants memory, not a mesh.
    if (count_ > document.source().bytes.size()) document.source().fail(what + " has no bytes");
    return;
  }
  bytes_ = buffers.view(*view);
  const std::size_t offset = document.whole(accessor, "byteOffset", 0);
  stride_ = document.whole(document.entry("bufferViews", *view), "byteStride", 0);
  if (stride_ == 0) stride_ = layout_.size();
  if (stride_ < layout_.size()) document.source().fail(what + " has a stride that is too short");
  if (offset > bytes_.size() || !fit(count_, stride_, layout_.size(), bytes_.size() - offset)) {
    document.source().fail(what + " reaches beyond its buffer view, which has " +
                           counted(bytes_.size(), "byte"));
  }
  bytes_.remove_prefix(offset);
}

void GltfAccessor::read_sparse(const GltfDocument& document, GltfBuffers& buffers,
                               const GltfJson& sparse) {
  const std::size_t count = document.required_whole(sparse, "count");
  const GltfJson* const indices = gltf_member(sparse, "indices");
  const GltfJson* const values = gltf_member(sparse, "values");
  const auto fail = [&]() { document.source().fail("a sparse accessor is broken"); };
  if (count > count_ || indices == nullptr || values == nullptr) fail();
  const auto view_of = [&](const GltfJson& part, std::size_t size) {
    std::string_view bytes = buffers.view(document.required_whole(part, "bufferView"));
    const std::size_t offset = document.whole(part, "byteOffset", 0);
    if (offset > bytes.size() || !fit(count, size, size, bytes.size() - offset)) fail();
    return bytes.substr(offset);
  };
  GltfLayout layout;
  const auto component = component_of(document.required_whole(*indices, "componentType"));
  if (!component) fail();
  layout.component = *component;
  GltfAccessor elements;
  elements.layout_ = layout;
  elements.count_ = count;
  elements.stride_ = layout.size();
  if (!elements.is_index()) fail();
  elements.bytes_ = view_of(*indices, layout.size());
  Sparse read{{}, view_of(*values, layout_.size())};
  read.elements.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t element = elements.index(i);
    if (element >= count_ || (i > 0 && element <= read.elements.back())) fail();
    read.elements.push_back(element);
  }
  sparse_ = std::move(read);
}

bool GltfAccessor::is_index() const {
  return layout_.components == 1 && !layout_.normalized &&
         (layout_.component == GltfComponent::uint8 || layout_.component == GltfComponent::uint16 ||
          layout_.component == GltfComponent::uint32);
}

const char* GltfAccessor::find(std::size_t element) const {
  if (sparse_) {
    const auto& elements = sparse_->elements;
    const auto found = std::lower_bound(elements.begin(), elements.end(), element);
    if (found != elements.end() && *found == element) {
      return sparse_->values.data() +
             layout_.size() * static_cast<std::size_t>(found - elements.begin());
    }
  }
  return bytes_.empty() ? nullptr : bytes_.data() + stride_ * element;
}

double GltfAccessor::value(std::size_t element, std::size_t component) const {
  const char* at = find(element);
  if (at == nullptr) return 0;
  at += layout_.offset_of(component);
  switch (layout_.component) {
    case GltfComponent::int8:
      return integer_at<std::int8_t>(at, layout_.normalized);
    case GltfComponent::uint8:
      return integer_at<std::uint8_t>(at, layout_.normalized);
    case GltfComponent::int16:
      return integer_at<std::int16_t>(at, layout_.normalized);
    case GltfComponent::uint16:
      return integer_at<std::uint16_t>(at, layout_.normalized);
    case GltfComponent::uint32:
      return integer_at<std::uint32_t>(at, layout_.normalized);
    case GltfComponent::real32:
      break;
  }
  return static_cast<double>(number_at<float>(at));
}

std::uint32_t GltfAccessor::index(std::size_t element) const {
  const char* const at = find(element);
  if (at == nullptr) return 0;
  switch (layout_.component) {
    case GltfComponent::uint8:
      return number_at<std::uint8_t>(at);
    case GltfComponent::uint16:
      return number_at<std::uint16_t>(at);
    default:
      return number_at<std::uint32_t>(at);
  }
}

}  // namespace meshrepair
