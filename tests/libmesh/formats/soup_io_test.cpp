// SPDX-License-Identifier: MIT
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <string>
#include <unistd.h>

#include <gtest/gtest.h>

#include <mesh/soup_io.h>

#include "each_seed.h"
#include "soup_fixtures.h"
#include "temporary_folder.h"

namespace meshrepair {
namespace {

using ::testing::HasSubstr;

constexpr SoupFormat kAllFormats[] = {
    SoupFormat::stl_binary, SoupFormat::stl_ascii,  SoupFormat::obj,
    SoupFormat::off,        SoupFormat::ply_binary, SoupFormat::ply_ascii,
    SoupFormat::glb,        SoupFormat::gltf,       SoupFormat::threemf};

class SoupFormats : public ::testing::TestWithParam<SoupFormat> {};

TEST_P(SoupFormats, RandomSoupComesBackBitForBit) {
  for_each_seed(1, 20, [&](std::uint64_t seed) {
    const TriangleSoup soup = random_soup(seed, is_single(GetParam()));
    const ReadResult result = read_text(format_soup(soup, GetParam()), "mesh");
    ASSERT_EQ(result.report.format, GetParam());
    ASSERT_EQ(corner_bits(result.soup), corner_bits(soup)) << "seed " << seed;
    if (!welds_points(GetParam())) {
      ASSERT_EQ(point_bits(result.soup), point_bits(soup)) << "seed " << seed;
      ASSERT_EQ(result.soup.triangles, soup.triangles) << "seed " << seed;
    }
    ASSERT_TRUE(result.report.warnings.empty());
  });
}

TEST_P(SoupFormats, NotFiniteCoordinatesComeBack) {
  TriangleSoup soup = tetrahedron();
  soup.points[1] = {std::nan(""), INFINITY, -INFINITY};
  if (GetParam() == SoupFormat::threemf) {  // which has finite numbers alone
    EXPECT_THROW((void)format_soup(soup, GetParam()), OutputError);
    return;
  }
  const ReadResult result = read_text(format_soup(soup, GetParam()), "mesh");
  ASSERT_EQ(result.soup.triangles.size(), 4u);
  const Vec3d& point = result.soup.points[result.soup.triangles[1][1]];
  EXPECT_TRUE(std::isnan(point.x()));
  EXPECT_EQ(point.y(), INFINITY);
  EXPECT_EQ(point.z(), -INFINITY);
  EXPECT_EQ(result.report.bad_points, 0u);
}

TEST_P(SoupFormats, ContentIsStrongerThanExtension) {
  for (const char* name : {"a.stl", "a.obj", "a.off", "a.ply", "a.txt", "a"}) {
    EXPECT_EQ(read_text(format_soup(tetrahedron(), GetParam()), name).report.format, GetParam())
        << name;
  }
}

TEST_P(SoupFormats, CommentsDoNotDisturb) {
  const std::string bytes = format_soup(tetrahedron(), GetParam(), {{"one", "face 99", ""}});
  EXPECT_EQ(corner_bits(read_text(bytes, "a").soup), corner_bits(tetrahedron()));
}

TEST_P(SoupFormats, FileComesBack) {
  const TemporaryFolder folder;
  write_soup(tetrahedron(), folder.path() / "mesh", {.format = GetParam(), .extras = {}});
  const ReadResult result = read_soup(folder.path() / "mesh");
  EXPECT_EQ(result.report.format, GetParam());
  EXPECT_EQ(result.report.bytes, std::filesystem::file_size(folder.path() / "mesh"));
  EXPECT_EQ(corner_bits(result.soup), corner_bits(tetrahedron()));
}

TEST_P(SoupFormats, NoMoreTrianglesThanTheLimitAreRead) {
  const std::string bytes = format_soup(tetrahedron(), GetParam());
  ReadOptions options;
  options.max_triangles = 4;
  EXPECT_EQ(read_soup(std::string_view(bytes), "a", options).soup.triangles.size(), 4u);
  options.max_triangles = 3;
  try {
    (void)read_soup(std::string_view(bytes), "a", options);
    FAIL();
  } catch (const LimitError& error) {
    EXPECT_THAT(error.what(), HasSubstr("a: limit of 3 triangles reached in stage 'read', "));
  }
}

TEST_P(SoupFormats, ReadingStopsWhenItIsToldTo) {
  class Stop : public ProgressObserver {
   public:
    bool cancelled() override { return true; }
  };
  Stop stop;
  ReadOptions options;
  options.progress = &stop;
  std::string bytes;
  TriangleSoup many = tetrahedron();
  for (int i = 0; i < 11; ++i) {
    const auto once = many.triangles;
    many.triangles.insert(many.triangles.end(), once.begin(), once.end());
  }
  bytes = format_soup(many, GetParam());
  EXPECT_THROW((void)read_soup(std::string_view(bytes), "a", options), Cancelled);
}

TEST_P(SoupFormats, EmptySoupIsWrittenAndRefused) {
  // An OBJ without points has no bytes at all.
  const std::string reason = GetParam() == SoupFormat::obj ? "is empty" : "holds no triangles";
  EXPECT_EQ(refusal_of(format_soup({}, GetParam()), "a"), "a: " + reason);
}

INSTANTIATE_TEST_SUITE_P(All, SoupFormats, ::testing::ValuesIn(kAllFormats),
                         [](const auto& tested) {
                           return replaced(std::string(format_name(tested.param)), " ", "");
                         });

TEST(FormatOfExtension, CaseDoesNotMatter) {
  EXPECT_EQ(format_of_extension("x/a.STL"), SoupFormat::stl_binary);
  EXPECT_EQ(format_of_extension("a.b.Obj"), SoupFormat::obj);
  EXPECT_EQ(format_of_extension("a.off"), SoupFormat::off);
  EXPECT_EQ(format_of_extension("a.ply"), SoupFormat::ply_binary);
  EXPECT_EQ(format_of_extension("a.glb"), SoupFormat::glb);
  EXPECT_EQ(format_of_extension("a.GLTF"), SoupFormat::gltf);
  EXPECT_EQ(format_of_extension("stl"), std::nullopt);
  EXPECT_EQ(format_of_extension("a.3MF"), SoupFormat::threemf);
  EXPECT_EQ(format_of_extension("a.zip"), std::nullopt);
}

TEST(ReadSoup, RefusalNamesTheFileAndTheReason) {
  const TemporaryFolder folder;
  const auto message_of = [](const std::filesystem::path& path) -> std::string {
    try {
      static_cast<void>(read_soup(path));
    } catch (const InputError& error) {
      return error.what();
    }
    return "not refused";
  };
  const std::filesystem::path missing = folder.path() / "missing.stl";
  EXPECT_EQ(message_of(missing),
            missing.string() + ": cannot be opened: No such file or directory");
  EXPECT_EQ(message_of(folder.path()), folder.path().string() + ": is a folder, not a file");
  const std::filesystem::path empty = folder.path() / "empty.stl";
  std::ofstream(empty).flush();
  EXPECT_EQ(message_of(empty), empty.string() + ": is empty");
}

TEST(ReadSoup, ForeignFormatsAreNamed) {
  EXPECT_THAT(refusal_of("PK\x03\x04 and so on", "a.3mf"), HasSubstr("ZIP archive"));
  EXPECT_THAT(refusal_of("\x1F\x8B and so on", "a.stl"), HasSubstr("gzip"));
  EXPECT_THAT(refusal_of(std::string(200, '\1'), "a.xyz"), HasSubstr("no known format"));
  EXPECT_THAT(refusal_of(std::string(200, '\1'), "a.obj"), HasSubstr("is not OBJ"));
  EXPECT_THAT(refusal_of("hello world\n", "a.ply"), HasSubstr("does not begin with 'ply'"));
  EXPECT_THAT(refusal_of("hello world\n", "a.stl"), HasSubstr("holds no triangles"));
  EXPECT_THAT(refusal_of("hello world\n", "a.off"), HasSubstr("a.off:1: "));
  EXPECT_EQ(refusal_of("\xEF\xBB\xBF", "a.off"), "a.off: is empty");
}

TEST(ReadSoup, PipesAreReadToTheirEnd) {
  const std::string bytes = format_soup(random_soup(1, true), SoupFormat::stl_binary);
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  ASSERT_EQ(::write(ends[1], bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  ::close(ends[1]);
  const ReadResult result = read_soup("/dev/fd/" + std::to_string(ends[0]));
  ::close(ends[0]);
  EXPECT_EQ(result.soup.triangles.size(), 300u);
}

TEST(WriteSoup, UnknownExtensionIsAUsageError) {
  EXPECT_THROW(write_soup(tetrahedron(), "mesh.xyz"), UsageError);
  EXPECT_THROW(write_soup(tetrahedron(), "-"), UsageError);
}

TEST(WriteSoup, CoordinatesThatDoNotFitAreNamedInFewDigits) {
  TriangleSoup soup = tetrahedron();
  soup.points[2] = {0, -1e300 / 9, 0};
  for (const auto& [format, name] :
       {std::pair(SoupFormat::stl_binary, "binary STL"), std::pair(SoupFormat::glb, "glTF")}) {
    try {
      (void)format_soup(soup, format);
      ADD_FAILURE();
    } catch (const OutputError& error) {
      EXPECT_EQ(error.what(), "a coordinate of -1.11111e+299 does not fit into " +
                                  std::string(name) + "; write another format");
    }
  }
}

TEST(ReadSoup, LongWordsAreShortenedInMessages) {
  const std::string word(300, '1');
  const std::string json = R"({"asset":{"version":")" + word + "\"}}";
  try {
    (void)read_soup(std::string_view(json), "a.gltf");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(),
              "a.gltf: is glTF of version " + word.substr(0, 40) + "...; 2.0 can be read");
  }
}

TEST(WriteSoup, ExtensionTellsTheFormat) {
  const TemporaryFolder folder;
  for (const char* name : {"a.stl", "a.obj", "a.off", "a.ply", "a.3mf"}) {
    write_soup(tetrahedron(), folder.path() / name);
    EXPECT_EQ(read_soup(folder.path() / name).report.format, format_of_extension(name));
  }
}

// Compilers have left out the rounding of the last elements of an array.
TEST(Float32, EveryPointIsRounded) {
  for (std::size_t count = 1; count < 40; ++count) {
    TriangleSoup soup;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = static_cast<double>(i) + 1.0 / 3;
      soup.points.emplace_back(x, -x, 7 * x);
    }
    for (const Vec3d& p : as_read_back(soup, SoupFormat::stl_binary).points) {
      for (int axis = 0; axis < 3; ++axis) {
        const volatile float rounded = static_cast<float>(p[axis]);
        EXPECT_EQ(static_cast<double>(rounded), p[axis]) << count;
      }
    }
  }
}

}  // namespace
}  // namespace meshrepair
