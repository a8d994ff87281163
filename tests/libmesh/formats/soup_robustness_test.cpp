// SPDX-License-Identifier: MIT
// Broken files: whatever the bytes, reading gives a valid soup or InputError.
#include <random>
#include <string>

#include <gtest/gtest.h>

#include <mesh/soup_io.h>

#include "soup_fixtures.h"

namespace meshrepair {
namespace {

struct Sample {
  std::string name;  // also of the test
  std::string extension;
  std::string bytes;
};

std::string big_endian_ply() {
  std::string bytes =
      "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty list uchar short "
      "tags\nproperty char x\n"
      "property char y\nproperty char z\nelement tristrips 1\nproperty list int int "
      "vertex_indices\n"
      "element face 1\nproperty list ushort uchar vertex_index\nproperty double area\nend_header\n";
  using namespace std::string_literals;
  bytes += "\1\0\7\0\0\0\0\1\0\0\0\0\1\0"s;
  bytes += "\0\0\0\3\0\0\0\0\0\0\0\1\0\0\0\2"s;
  bytes += "\0\3\0\1\2........"s;
  return bytes;
}

std::string binary_off() {
  using namespace std::string_literals;
  return "OFF BINARY\n"s + "\0\0\0\3\0\0\0\2\0\0\0\0"s + std::string(36, '\0') +
         "\0\0\0\3\0\0\0\0\0\0\0\1\0\0\0\2\0\0\0\0"s +
         "\0\0\0\3\0\0\0\2\0\0\0\1\0\0\0\0\0\0\0\1\0\0\0\0"s;
}

std::vector<Sample> samples() {
  const TriangleSoup soup = tetrahedron();
  const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1 \\\n 2\n";
  return {
      {"StlBinary", ".stl", format_soup(soup, SoupFormat::stl_binary)},
      {"StlAscii", ".stl", format_soup(soup, SoupFormat::stl_ascii)},
      {"Obj", ".obj",
       points + "vn 0 0 1\nf 1/1/1 2//1 3 4\nf -1 -2 -3\nf 1 2 \\\n5\nf 1 2 3 4 5\n"},
      {"Off", ".off", format_soup(soup, SoupFormat::off) + "4 0 1 2 3 255 0 0\n"},
      {"OffOneLine", ".off", replaced("ST" + format_soup(soup, SoupFormat::off), "\n", " ")},
      {"OffBinary", ".off", binary_off()},
      {"PlyBinary", ".ply", format_soup(soup, SoupFormat::ply_binary)},
      {"PlyAscii", ".ply", format_soup(soup, SoupFormat::ply_ascii)},
      {"Glb", ".glb", format_soup(soup, SoupFormat::glb)},
      {"Gltf", ".gltf", format_soup(soup, SoupFormat::gltf)},
      {"Threemf", ".3mf", format_soup(soup, SoupFormat::threemf)},
      {"PlyBigEndian", ".ply", big_endian_ply()},
  };
}

// True when it was read.
bool read_broken(const std::string& bytes, const std::string& extension) {
  // A copy of exactly these bytes, so that a sanitizer sees every byte read beyond them.
  const std::vector<char> exact(bytes.begin(), bytes.end());
  try {
    const ReadResult result =
        read_soup(std::string_view(exact.data(), exact.size()), "broken" + extension);
    expect_valid_indices(result.soup);
    EXPECT_FALSE(result.soup.triangles.empty());
    return true;
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return false;
  }
}

class BrokenFiles : public ::testing::TestWithParam<Sample> {};

TEST_P(BrokenFiles, WholeFileIsRead) {
  EXPECT_TRUE(read_broken(GetParam().bytes, GetParam().extension));
}

TEST_P(BrokenFiles, FilesCutAtAnyByteAreReadOrRefused) {
  const std::string& bytes = GetParam().bytes;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    SCOPED_TRACE(size);
    const bool read = read_broken(bytes.substr(0, size), GetParam().extension);
    EXPECT_TRUE(size > 0 || !read);
  }
}

TEST_P(BrokenFiles, FilesWithReplacedBytesAreReadOrRefused) {
  std::mt19937 random(20240607);
  for (int round = 0; round < 3000; ++round) {
    SCOPED_TRACE(round);
    std::string bytes = GetParam().bytes;
    for (unsigned count = 1 + random() % 8; count > 0; --count) {
      bytes[random() % bytes.size()] = static_cast<char>(random() % 256);
    }
    EXPECT_NO_THROW((void)read_broken(bytes, GetParam().extension));
    if (::testing::Test::HasFailure()) return;
  }
}

// Digits, signs and separators do more harm to a text than bytes at random.
TEST_P(BrokenFiles, FilesWithChangedTextAreReadOrRefused) {
  constexpr std::string_view kAlphabet = "0123456789-+.e,/\\# \t\r\nfvnx";
  std::mt19937 random(19700101);
  for (int round = 0; round < 3000; ++round) {
    SCOPED_TRACE(round);
    std::string bytes = GetParam().bytes;
    for (unsigned count = 1 + random() % 8; count > 0; --count) {
      const std::size_t at = random() % bytes.size();
      if (random() % 2 == 0) {
        bytes.erase(at, 1 + random() % 4);
      } else {
        bytes.insert(at, 1 + random() % 3, kAlphabet[random() % kAlphabet.size()]);
      }
    }
    EXPECT_NO_THROW((void)read_broken(bytes, GetParam().extension));
    if (::testing::Test::HasFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(All, BrokenFiles, ::testing::ValuesIn(samples()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace meshrepair
