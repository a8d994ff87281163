// SPDX-License-Identifier: MIT
// From every format to every other: what the second can hold of what was read from the first comes
// back bit for bit.
#include <array>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/soup_io.h>

#include "expected_in_format.h"
#include "formats/obj/obj_io.h"
#include "mixed_soups.h"
#include "share_of_cases.h"
#include "temporary_folder.h"
#include "threemf_peer.h"

namespace meshrepair {
namespace {

namespace fs = std::filesystem;

constexpr std::array kFormats = {
    SoupFormat::obj,  SoupFormat::ply_binary, SoupFormat::ply_ascii,  SoupFormat::glb,
    SoupFormat::gltf, SoupFormat::threemf,    SoupFormat::stl_binary, SoupFormat::stl_ascii};

std::string name_of_format(SoupFormat format) {
  std::string name(format_name(format));
  std::erase(name, ' ');
  return name;
}

// As write_soup() does, but does not wait for the disk. Returns the bytes of the mesh.
std::string write_mesh(const fs::path& path, SoupFormat format, const TriangleSoup& soup,
                       const Attributes& attributes) {
  SoupExtras extras;
  extras.attributes = &attributes;
  extras.folder = path.parent_path();
  std::vector<BundledFile> files;
  if (format == SoupFormat::obj) {
    files = obj_files(soup, extras, path);
  } else {
    files.push_back({path, format_soup(soup, format, extras)});
  }
  for (const BundledFile& file : files) {
    fs::remove(file.path);  // some systems wait for the disk where a file is written over
    std::ofstream out(file.path, std::ios::binary);
    out << file.bytes;
    EXPECT_TRUE(out.good());
  }
  return files.back().bytes;
}

// Its bytes, and what is read again.
struct Written {
  std::string bytes;
  ReadResult mesh;
};

Written written(const fs::path& stem, SoupFormat format, const TriangleSoup& soup,
                const Attributes& attributes) {
  fs::path path = stem;
  path += format == SoupFormat::obj ? ".obj" : ".mesh";
  Written result;
  result.bytes = write_mesh(path, format, soup, held_by(format, attributes));
  ReadOptions options;
  options.attributes = true;
  result.mesh = read_soup(path, options);
  EXPECT_EQ(result.mesh.report.format, format);
  EXPECT_THAT(result.mesh.report.warnings, ::testing::IsEmpty());
  return result;
}

const CornerAttribute* find_set(const Attributes& attributes, const ExpectedSet& set) {
  std::size_t number = 0;
  for (const CornerAttribute& made : attributes.corners) {
    if (made.kind == set.kind && number++ == set.number) return &made;
  }
  return nullptr;
}

void expect_corners(const ReadResult& made, const TriangleSoup& soup,
                    const std::vector<std::size_t>& order) {
  ASSERT_EQ(made.soup.triangles.size(), soup.triangles.size());
  for (std::size_t t = 0; t < order.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_EQ(made.soup.points[made.soup.triangles[t][k]],
                soup.points[soup.triangles[order[t]][k]]);
    }
  }
}

using Kind = CornerAttribute::Kind;
using Kinds = std::set<Kind>;

void expect_sets(const Attributes& made, const ExpectedMesh& expected, Kinds& compared) {
  for (const ExpectedSet& set : expected.sets) {
    const CornerAttribute* const found = find_set(made, set);
    for (std::size_t c = 0; c < set.of_corner.size(); ++c) {
      const std::vector<double>& values = set.of_corner[3 * expected.order[c / 3] + c % 3];
      if (values.empty()) continue;
      ASSERT_NE(found, nullptr) << "kind " << static_cast<int>(set.kind);
      const std::uint32_t number = found->of_corner[c];
      ASSERT_NE(number, kNone) << "kind " << static_cast<int>(set.kind) << ", corner " << c;
      for (std::size_t i = 0; i < values.size(); ++i) {
        ASSERT_EQ(std::bit_cast<std::uint64_t>(found->values[found->components * number + i]),
                  std::bit_cast<std::uint64_t>(values[i]))
            << "kind " << static_cast<int>(set.kind) << ", corner " << c << ", number " << i;
      }
      compared.insert(set.kind);
    }
    if (found != nullptr) {
      ASSERT_EQ(found->of_corner.size(), set.of_corner.size());
    }
  }
}

// `none` is a label that says the same as none.
void expect_labels(const TriangleLabels& made, const std::vector<std::string>& expected,
                   const std::vector<std::size_t>& order, const std::string& none = "-") {
  const auto names = names_by_triangle(made, order.size());
  for (std::size_t t = 0; t < order.size(); ++t) {
    const std::string& name = expected[order[t]];
    ASSERT_EQ(names[t] == none ? "-" : names[t], name == none ? "-" : name) << t;
  }
}

void expect_looks(const Attributes& made, const ExpectedMesh& expected) {
  for (std::size_t t = 0; t < expected.order.size(); ++t) {
    const std::size_t from = expected.order[t];
    if (!expected.looks[from]) continue;
    const std::uint32_t material = made.materials.of_triangle.at(t);
    ASSERT_LT(material, made.looks.size());
    for (std::size_t i = 0; i < 4; ++i) {  // glTF has them as light, to the last place
      ASSERT_NEAR(made.looks[material].colour[i], expected.looks[from]->colour[i], 1e-15);
    }
    if (expected.pictures[from].empty()) continue;
    ASSERT_EQ(picture_of(made, material), expected.pictures[from]);
  }
}

// The soup and its attributes, as far as the format can hold them. Adds the kinds of values that
// were there.
void expect_held(const ReadResult& made, const TriangleSoup& soup, const Attributes& attributes,
                 SoupFormat format, Kinds& compared) {
  const ExpectedMesh expected = expected_in(format, soup, attributes);
  expect_corners(made, soup, expected.order);
  expect_sets(made.attributes, expected, compared);
  expect_labels(made.attributes.materials, expected.materials, expected.order);
  expect_labels(made.attributes.groups, expected.groups, expected.order);
  expect_labels(made.attributes.objects, expected.objects, expected.order);
  expect_labels(made.attributes.smoothing, expected.smoothing, expected.order, "off");
  expect_looks(made.attributes, expected);
}

// Those that both formats can hold.
Kinds kinds_of(SoupFormat first, SoupFormat second) {
  Attributes all;
  for (const Kind kind : {Kind::texture, Kind::normal, Kind::tangent, Kind::colour, Kind::other}) {
    all.corners.emplace_back().kind = kind;
  }
  Kinds kinds;
  for (const CornerAttribute& set : held_by(second, held_by(first, all)).corners) {
    kinds.insert(set.kind);
  }
  // The one has colours of points, the other of triangles.
  if (first == SoupFormat::obj && second == SoupFormat::stl_binary) kinds.clear();
  return kinds;
}

// Puts the pictures into files: PLY has no others.
void move_pictures_to(const fs::path& folder, Attributes& attributes) {
  for (std::size_t i = 0; i < attributes.images.size(); ++i) {
    Image& image = attributes.images[i];
    image.name = "picture_" + std::to_string(i) + ".png";
    image.path = (folder / image.name).string();
    fs::remove(image.path);
    std::ofstream(image.path, std::ios::binary) << *image.bytes;
    image.bytes = nullptr;
  }
}

class FormatPairs : public ::testing::TestWithParam<SoupFormat> {};

TEST_P(FormatPairs, EachPairKeepsWhatBothHoldBitForBit) {
  const TemporaryFolder folder;
  const unsigned seeds = share_of_cases(200u);
  std::map<SoupFormat, Kinds> compared;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    TexturedSoup given = random_mixed_soup(seed);
    if (seed % 2 == 1) move_pictures_to(folder.path(), given.attributes);
    SCOPED_TRACE(seed);
    const ReadResult first =
        written(folder.path() / "first", GetParam(), given.soup, given.attributes).mesh;
    expect_held(first, given.soup, given.attributes, GetParam(), compared[GetParam()]);
    for (const SoupFormat second : kFormats) {
      SCOPED_TRACE("to " + name_of_format(second));
      const Written made = written(folder.path() / "second", second, first.soup, first.attributes);
      expect_held(made.mesh, first.soup, first.attributes, second, compared[second]);
      if (second == SoupFormat::threemf) expect_read_by_peer(made.bytes, first.soup, false);
      if (HasFatalFailure()) return;
    }
  }
  for (const SoupFormat second : kFormats) {
    EXPECT_EQ(compared[second], kinds_of(GetParam(), second)) << name_of_format(second);
  }
}

INSTANTIATE_TEST_SUITE_P(From, FormatPairs, ::testing::ValuesIn(kFormats),
                         [](const auto& tested) { return name_of_format(tested.param); });

}  // namespace
}  // namespace meshrepair
