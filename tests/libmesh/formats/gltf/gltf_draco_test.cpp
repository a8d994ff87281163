// SPDX-License-Identifier: MIT
// Primitives compressed by Draco.
#include <draco/compression/expert_encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gmock/gmock.h>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include <mesh/soup_io.h>

#include "gltf_maker.h"
#include "soup_fixtures.h"

namespace meshrepair {
namespace {

using ::testing::HasSubstr;

// A square of 2 n^2 triangles that lies in a plane, with texture coordinates.
class DracoSquare {
 public:
  explicit DracoSquare(int n, bool sequential = false) : faces_(2 * n * n) {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(faces_);
    const int positions =
        builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int texture =
        builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
    int face = 0;
    const auto add = [&](std::array<std::array<int, 2>, 3> corners) {
      std::array<std::array<float, 3>, 3> p{};
      std::array<std::array<float, 2>, 3> uv{};
      for (std::size_t k = 0; k < 3; ++k) {
        p[k] = {static_cast<float>(corners[k][0]), static_cast<float>(corners[k][1]), 0};
        uv[k] = {p[k][0] / static_cast<float>(n), p[k][1] / static_cast<float>(n)};
      }
      const draco::FaceIndex f(static_cast<std::uint32_t>(face++));
      builder.SetAttributeValuesForFace(positions, f, p[0].data(), p[1].data(), p[2].data());
      builder.SetAttributeValuesForFace(texture, f, uv[0].data(), uv[1].data(), uv[2].data());
    };
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        add({{{x, y}, {x + 1, y}, {x + 1, y + 1}}});
        add({{{x, y}, {x + 1, y + 1}, {x, y + 1}}});
      }
    }
    const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
    position_id_ = mesh->attribute(positions)->unique_id();
    texture_id_ = mesh->attribute(texture)->unique_id();
    draco::ExpertEncoder encoder(*mesh);
    encoder.SetEncodingMethod(sequential ? draco::MESH_SEQUENTIAL_ENCODING
                                         : draco::MESH_EDGEBREAKER_ENCODING);
    if (!sequential) {
      encoder.SetAttributeQuantization(positions, 12);
      encoder.SetAttributeQuantization(texture, 12);
    }
    draco::EncoderBuffer buffer;
    if (!encoder.EncodeToBuffer(&buffer).ok()) throw std::runtime_error("draco");
    bytes_.assign(buffer.data(), buffer.size());
    vertices_ = mesh->num_points();
  }

  [[nodiscard]] const std::string& bytes() const { return bytes_; }

  [[nodiscard]] std::string glb(const std::string& bytes) const {
    GltfMaker maker;
    const std::size_t view = maker.add_view(bytes);
    maker.add("accessors", {{"componentType", 5126}, {"count", vertices_}, {"type", "VEC3"}});
    maker.add("accessors", {{"componentType", 5126}, {"count", vertices_}, {"type", "VEC2"}});
    maker.add("accessors", {{"componentType", 5125}, {"count", 3 * faces_}, {"type", "SCALAR"}});
    TestJson& primitive = maker.add_mesh(0, 2);
    primitive["attributes"]["TEXCOORD_0"] = 1;
    primitive["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", view},
        {"attributes", {{"POSITION", position_id_}, {"TEXCOORD_0", texture_id_}}}};
    maker.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    maker.root["extensionsUsed"] = {"KHR_draco_mesh_compression"};
    return maker.glb();
  }

 private:
  int faces_;
  std::uint32_t position_id_ = 0, texture_id_ = 0;
  std::size_t vertices_ = 0;
  std::string bytes_;
};

TEST(GltfDraco, ExactTrianglesComeBack) {
  const DracoSquare square(5, true);
  ReadOptions options;
  options.attributes = true;
  const std::string glb = square.glb(square.bytes());
  const ReadResult read = read_soup(std::string_view(glb), "a", options);
  EXPECT_EQ(read.soup.triangles.size(), 50u);
  EXPECT_EQ(read.soup.points.size(), 36u);
  const CornerAttribute& texture = read.attributes.corners.at(0);
  for (std::size_t i = 0; i < 150; ++i) {
    const Vec3d& point = read.soup.points[read.soup.triangles[i / 3][i % 3]];
    const double* const uv = texture.values.data() + 2 * std::size_t{texture.of_corner[i]};
    EXPECT_EQ(static_cast<float>(uv[0]), static_cast<float>(point.x()) / 5.0f);
    EXPECT_EQ(static_cast<float>(1 - uv[1]), static_cast<float>(point.y()) / 5.0f);
  }
  // What is written is not compressed, and says so.
  const std::string written =
      format_soup(read.soup, SoupFormat::glb, {.attributes = &read.attributes});
  EXPECT_EQ(written.find("draco"), std::string::npos);
  EXPECT_EQ(read_text(written, "a").soup.points.size(), 36u);
}

TEST(GltfDraco, EdgebreakerIsRead) {
  const DracoSquare square(20);
  const TriangleSoup soup = read_text(square.glb(square.bytes()), "a").soup;
  EXPECT_EQ(soup.triangles.size(), 800u);
  EXPECT_EQ(soup.points.size(), 441u);
}

// What compresses best of all is not taken for a lie.
TEST(GltfDraco, LargeRegularMeshesAreRead) {
  const DracoSquare square(512);
  RecordProperty("triangles_per_byte", static_cast<int>(524288 / square.bytes().size()));
  EXPECT_EQ(read_text(square.glb(square.bytes()), "a").soup.triangles.size(), 524288u);
}

TEST(GltfDraco, GarbageIsRefusedWithoutTakingMemory) {
  std::mt19937 random(7);
  for (const bool sequential : {true, false}) {
    const DracoSquare square(6, sequential);
    for (int round = 0; round < 3000; ++round) {
      std::string bytes = square.bytes();
      if (round % 3 == 0) bytes.resize(random() % bytes.size());
      for (int i = 0; i < 3 && !bytes.empty(); ++i) {
        const std::size_t range =
            round % 2 == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 40);
        bytes[random() % range] = static_cast<char>(random());
      }
      try {
        expect_valid_indices(read_text(square.glb(bytes), "a").soup);
      } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      }
    }
  }
}

TEST(GltfDraco, CountsThatTheBytesCannotHoldAreRefused) {
  const DracoSquare square(6, true);
  std::string bytes = square.bytes();
  // The number of triangles, behind the header of 11 bytes.
  bytes.replace(11, 1, "\xF0\xFF\xFF\x07");
  EXPECT_THAT(refusal_of(square.glb(bytes), "a"), HasSubstr("promise more than"));
}

}  // namespace
}  // namespace meshrepair
