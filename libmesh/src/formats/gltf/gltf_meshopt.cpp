#include "gltf_meshopt.h"

#include <meshoptimizer.h>

namespace meshrepair {
namespace {

// Of bytes of a file none stands for more: of vertices two bits at least for 16 bytes, of
// triangles a byte for three indices.
constexpr std::size_t kMostExpansion = 64;

bool is_possible(const MeshoptLayout& layout, std::size_t bytes) {
  const bool is_good = layout.mode == "ATTRIBUTES"
                           ? layout.stride > 0 && layout.stride <= 256 && layout.stride % 4 == 0
                           : layout.stride == 2 || layout.stride == 4;
  return is_good && layout.count / kMostExpansion <= bytes / layout.stride &&
         (layout.mode != "TRIANGLES" || layout.count % 3 == 0);
}

bool decode(const MeshoptLayout& layout, std::string_view bytes, std::string& decoded) {
  const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
  if (layout.mode == "ATTRIBUTES") {
    return meshopt_decodeVertexBuffer(decoded.data(), layout.count, layout.stride, data,
                                      bytes.size()) == 0;
  }
  if (layout.mode == "TRIANGLES") {
    return meshopt_decodeIndexBuffer(decoded.data(), layout.count, layout.stride, data,
                                     bytes.size()) == 0;
  }
  return layout.mode == "INDICES" &&
         meshopt_decodeIndexSequence(decoded.data(), layout.count, layout.stride, data,
                                     bytes.size()) == 0;
}

bool filter(const MeshoptLayout& layout, std::string& decoded) {
  if (layout.filter.empty() || layout.filter == "NONE") return true;
  if (layout.mode != "ATTRIBUTES") return false;
  if (layout.filter == "OCTAHEDRAL" && (layout.stride == 4 || layout.stride == 8)) {
    meshopt_decodeFilterOct(decoded.data(), layout.count, layout.stride);
  } else if (layout.filter == "QUATERNION" && layout.stride == 8) {
    meshopt_decodeFilterQuat(decoded.data(), layout.count, layout.stride);
  } else if (layout.filter == "EXPONENTIAL") {
    meshopt_decodeFilterExp(decoded.data(), layout.count, layout.stride);
  } else {
    return false;
  }
  return true;
}

}  // namespace

std::string decode_meshopt(const MeshSource& source, std::string_view bytes,
                           const MeshoptLayout& layout) {
  if (!is_possible(layout, bytes.size())) {
    source.fail("a compressed buffer view cannot hold what it promises");
  }
  std::string decoded(layout.count * layout.stride, '\0');
  if (!decode(layout, bytes, decoded) || !filter(layout, decoded)) {
    source.fail("a compressed buffer view is broken");
  }
  return decoded;
}

}  // namespace meshrepair
