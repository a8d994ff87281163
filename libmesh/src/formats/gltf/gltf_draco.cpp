// SPDX-License-Identifier: MIT
// Draco takes memory as headers in its bytes say. So its two decoders are asked to look at what is
// said before anything is done about it.
#include "gltf_draco.h"

#include <algorithm>
#include <draco/compression/config/decoder_options.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/decoder_buffer.h>
#include <draco/core/varint_decoding.h>
#include <draco/mesh/mesh.h>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace meshrepair {
namespace {

// Of a byte. Regular meshes that lie in a plane come to some tens.
constexpr std::size_t kMostTrianglesPerByte = 128;
// Of a compressed byte, all attributes together.
constexpr std::size_t kMostBytesPerByte = 4096;
constexpr std::size_t kBytesGranted = 4096;

struct DracoLimits {
  std::size_t triangles = 0;
  std::size_t bytes = 0;
  bool exceeded = false;
};

template <class Decoder>
class LimitedDecoder final : public Decoder {
 public:
  explicit LimitedDecoder(DracoLimits& limits) : limits_(limits) {}

 protected:
  bool DecodeConnectivity() override {
    draco::DecoderBuffer ahead = *this->buffer();
    std::uint32_t triangles = 0, points = 0;
    if constexpr (std::is_same_v<Decoder, draco::MeshEdgebreakerDecoder>) {
      std::uint8_t traversal = 0;
      if (!ahead.Decode(&traversal) || !draco::DecodeVarint(&points, &ahead)) return false;
    }
    if (!draco::DecodeVarint(&triangles, &ahead)) return false;
    if (triangles > limits_.triangles || points > 3 * limits_.triangles) {
      limits_.exceeded = true;
      return false;
    }
    return Decoder::DecodeConnectivity();
  }

  // All attributes are declared by now, and none has values yet.
  bool DecodeAllAttributes() override {
    const draco::PointCloud& cloud = *this->point_cloud();
    std::size_t size = 0;
    for (std::int32_t i = 0; i < cloud.num_attributes(); ++i) {
      const draco::PointAttribute& attribute = *cloud.attribute(i);
      const int length = draco::DataTypeLength(attribute.data_type());
      if (length <= 0 || attribute.num_components() == 0) return false;
      size += static_cast<std::size_t>(length) * attribute.num_components();
    }
    if (size > limits_.bytes / std::max<std::size_t>(cloud.num_points(), 1)) {
      limits_.exceeded = true;
      return false;
    }
    return Decoder::DecodeAllAttributes();
  }

 private:
  DracoLimits& limits_;
};

template <class Decoder>
bool decode_with(DracoLimits& limits, draco::DecoderBuffer& buffer, draco::Mesh& mesh) {
  LimitedDecoder<Decoder> decoder(limits);
  return decoder.Decode(draco::DecoderOptions(), &buffer, &mesh).ok();
}

bool decode_mesh(DracoLimits& limits, std::string_view bytes, draco::Mesh& mesh) {
  draco::DecoderBuffer buffer, ahead;
  buffer.Init(bytes.data(), bytes.size());
  ahead.Init(bytes.data(), bytes.size());
  draco::DracoHeader header;
  if (!draco::PointCloudDecoder::DecodeHeader(&ahead, &header).ok() ||
      header.encoder_type != draco::TRIANGULAR_MESH) {
    return false;
  }
  // Before, numbers stood in another way; glTF has never had those versions.
  if (header.version_major != 2 || header.version_minor != 2) return false;
  if (header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING) {
    return decode_with<draco::MeshSequentialDecoder>(limits, buffer, mesh);
  }
  return header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING &&
         decode_with<draco::MeshEdgebreakerDecoder>(limits, buffer, mesh);
}

std::optional<GltfComponent> component_of_draco(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
      return GltfComponent::int8;
    case draco::DT_UINT8:
      return GltfComponent::uint8;
    case draco::DT_INT16:
      return GltfComponent::int16;
    case draco::DT_UINT16:
      return GltfComponent::uint16;
    case draco::DT_UINT32:
      return GltfComponent::uint32;
    case draco::DT_FLOAT32:
      return GltfComponent::real32;
    default:
      return std::nullopt;
  }
}

std::optional<GltfAccessor> take_attribute(const draco::Mesh& mesh, const DracoAttribute& wanted) {
  const draco::PointAttribute* const attribute = mesh.GetAttributeByUniqueId(wanted.id);
  if (attribute == nullptr || attribute->buffer() == nullptr) return std::nullopt;
  const auto component = component_of_draco(attribute->data_type());
  if (!component || attribute->num_components() == 0) return std::nullopt;
  GltfLayout layout;
  layout.component = *component;
  layout.normalized = wanted.normalized;
  layout.components = layout.rows = attribute->num_components();
  const auto* const data = reinterpret_cast<const char*>(attribute->buffer()->data());
  const std::size_t size = layout.size();
  std::string bytes;
  bytes.reserve(size * mesh.num_points());
  for (draco::PointIndex p(0); p < mesh.num_points(); ++p) {
    const draco::AttributeValueIndex value = attribute->mapped_index(p);
    const auto at = static_cast<std::size_t>(attribute->GetBytePos(value));
    if (value.value() >= attribute->size() || at + size > attribute->buffer()->data_size()) {
      return std::nullopt;
    }
    bytes.append(data + at, size);
  }
  return GltfAccessor(layout, std::move(bytes));
}

}  // namespace

DracoMesh decode_draco(const MeshSource& source, std::string_view bytes, std::size_t most_triangles,
                       const std::vector<DracoAttribute>& attributes) {
  DracoLimits limits;
  limits.triangles = std::min(most_triangles, kMostTrianglesPerByte * bytes.size());
  limits.bytes = kMostBytesPerByte * bytes.size() + kBytesGranted;
  draco::Mesh mesh;
  bool is_good = false;
  try {
    is_good = decode_mesh(limits, bytes, mesh);
  } catch (const std::exception&) {  // lengths that no container has
  }
  if (limits.exceeded) source.fail("compressed triangles promise more than their bytes can hold");
  if (!is_good) source.fail("compressed triangles are broken");
  DracoMesh result;
  result.corners.reserve(3 * std::size_t{mesh.num_faces()});
  for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f) {
    for (const draco::PointIndex& corner : mesh.face(f)) result.corners.push_back(corner.value());
  }
  for (const DracoAttribute& wanted : attributes) {
    std::optional<GltfAccessor> taken = take_attribute(mesh, wanted);
    if (!taken) source.fail("compressed triangles lack an attribute that is theirs");
    result.attributes.push_back(std::move(*taken));
  }
  return result;
}

}  // namespace meshrepair
