// SPDX-License-Identifier: MIT
// Packed files: any bytes are a mesh, or one line that says why not; and what is packed comes out
// as it was.
#include <string>
#include <vector>

#include <mesh/mesh_source.h>
#include <mesh/packing.h>
#include <mesh/point_io.h>

#include "check_reading.h"

namespace {

using namespace meshrepair;

// Larger ones are slow to write in many ways.
constexpr std::size_t kMostTriangles = 20000;

void check_round_trip(std::string_view bytes, Packing packing) {
  const std::string packed = pack_bytes(bytes, packing);
  testing::require(packing_of_content(packed) == packing, "is not taken for what it is");
  std::vector<Warning> warnings;
  const MeshSource source{packed, "back"};
  const TrivialVector<char> back = unpack(source, packing, warnings);
  testing::require(std::string_view(back.begin(), back.size()) == bytes, "other bytes come out");
  testing::require(warnings.empty(), "what we packed is warned of");
}

void check_unpacking(std::string_view bytes) {
  const Packing packing = packing_of_content(bytes);
  if (packing != Packing::gzip && packing != Packing::zstd) return;
  try {
    std::vector<Warning> warnings;
    const MeshSource source{bytes, "any"};
    const TrivialVector<char> unpacked = unpack(source, packing, warnings);
    testing::require(unpacked.size() <= (std::size_t{32} << 20) + 200 * bytes.size(),
                     "more came out than may");
    for (const Warning& warning : warnings) testing::require_one_line(warning.text);
  } catch (const InputError& error) {
    testing::require_one_line(error.what());
  }
}

void check_meshes(std::string_view bytes) {
  ReadOptions options;
  options.attributes = true;
  options.max_triangles = kMostTriangles;
  try {
    const MeshOrPoints result = read_mesh_or_points(bytes, "any", options);
    if (!result.mesh) return;
    testing::require_valid_indices(result.mesh->soup);
    testing::require_consistent(*result.mesh, bytes.size());
  } catch (const LimitError&) {
  } catch (const InputError& error) {
    testing::require_one_line(error.what());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  check_unpacking(bytes);
  check_meshes(bytes);
  check_round_trip(bytes, Packing::gzip);
  check_round_trip(bytes, Packing::zstd);
  return 0;
}
