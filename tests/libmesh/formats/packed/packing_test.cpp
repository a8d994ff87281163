// SPDX-License-Identifier: MIT
#include <array>
#include <fstream>
#include <gmock/gmock.h>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include <base/error.h>
#include <base/file_bytes.h>
#include <mesh/packing.h>
#include <mesh/point_io.h>
#include <mesh/soup_io.h>

#include "packed_bytes.h"
#include "soup_fixtures.h"
#include "temporary_folder.h"

namespace meshrepair {
namespace {

constexpr std::array kAllFormats = {
    SoupFormat::stl_binary, SoupFormat::stl_ascii,  SoupFormat::obj,
    SoupFormat::off,        SoupFormat::ply_binary, SoupFormat::ply_ascii,
    SoupFormat::glb,        SoupFormat::gltf,       SoupFormat::threemf};

std::string unpacked_text(const std::filesystem::path& path) {
  return std::string(FileBytes(path).bytes());
}

TEST(Packing, IsToldByTheName) {
  EXPECT_EQ(packing_of_extension("a/part.obj.gz"), Packing::gzip);
  EXPECT_EQ(packing_of_extension("PART.STL.ZST"), Packing::zstd);
  EXPECT_EQ(packing_of_extension("part.zip"), Packing::none);
  EXPECT_EQ(packing_of_extension("gz"), Packing::none);
  EXPECT_EQ(without_packing("a/part.obj.gz"), "a/part.obj");
  EXPECT_EQ(without_packing("a.gz/part.obj"), "a.gz/part.obj");
  EXPECT_EQ(format_of_extension("part.obj.gz"), SoupFormat::obj);
  EXPECT_EQ(format_of_extension("part.3MF.Zst"), SoupFormat::threemf);
  EXPECT_EQ(format_of_extension("part.gz"), std::nullopt);
  EXPECT_EQ(format_of_extension("part.obj.gz.gz"), std::nullopt);
}

TEST(Packing, GivesTheSameBytesWithoutTimeAndName) {
  const std::string bytes = format_soup(random_soup(1, false), SoupFormat::obj);
  for (const Packing packing : {Packing::gzip, Packing::zstd}) {
    EXPECT_EQ(pack_bytes(bytes, packing), pack_bytes(bytes, packing));
    EXPECT_EQ(packing_of_content(pack_bytes(bytes, packing)), packing);
    EXPECT_LT(pack_bytes(bytes, packing).size(), bytes.size());
  }
  EXPECT_EQ(gzip_of(bytes).substr(3, 5), std::string(5, '\0'));  // no flags, no time
}

TEST(Packing, EveryFormatComesBackBitForBit) {
  const TemporaryFolder folder;
  for (const SoupFormat format : kAllFormats) {
    TriangleSoup soup = tetrahedron();
    soup.points[1] = {1.0 / 3, 0, 0};
    const std::string plain = format_soup(soup, format);
    for (const char* extension : {".gz", ".zst"}) {
      SCOPED_TRACE(std::string(format_name(format)) + extension);
      const auto path = folder.path() / (std::string("part.mesh") + extension);
      write_soup(soup, path, {.format = format});
      EXPECT_LT(unpacked_text(path).size(), plain.size() + 64);
      const ReadResult back = read_soup(path);
      const ReadResult same = read_soup(std::string_view(plain), "part.mesh");
      EXPECT_EQ(back.report.format, format);
      EXPECT_EQ(back.report.bytes, plain.size());
      EXPECT_EQ(back.report.packed.bytes, unpacked_text(path).size());
      EXPECT_EQ(back.report.packed.packing, packing_of_extension(path));
      EXPECT_EQ(back.soup.triangles, same.soup.triangles);
      EXPECT_EQ(point_bits(back.soup), point_bits(same.soup));
    }
  }
}

TEST(Packing, LargeFilesComeBack) {
  TriangleSoup soup;
  std::mt19937_64 random(7);
  for (std::uint32_t i = 0; i < 60000; ++i) {
    soup.points.emplace_back(static_cast<double>(random() % 1000), static_cast<double>(i), 0.5);
    soup.triangles.push_back({i, (i + 1) % 60000, (i + 2) % 60000});
  }
  const std::string text = format_soup(soup, SoupFormat::off);
  for (const Packing packing : {Packing::gzip, Packing::zstd}) {
    const std::string bytes = pack_bytes(text, packing);
    const ReadResult back = read_soup(std::string_view(bytes), "part.off");
    EXPECT_EQ(back.soup.triangles, soup.triangles);
    EXPECT_EQ(point_bits(back.soup), point_bits(soup));
  }
}

TEST(Packing, MessagesHaveTheNameOfTheFile) {
  EXPECT_EQ(refusal_of(gzip_of("v 0 0 0\nf 1 2 3\n"), "part.obj.gz").rfind("part.obj.gz: ", 0), 0u);
  EXPECT_EQ(refusal_of(gzip_of("OFF\n3 1 0\n0 0 0\nx"), "a.off.gz").rfind("a.off.gz:", 0), 0u);
  EXPECT_EQ(refusal_of(zip_of({{"d/part.obj", "v 0 0 0\n"}}), "parts.zip")
                .rfind("parts.zip: d/part.obj: ", 0),
            0u);
}

TEST(Packing, TheNameBeforeTellsTheFormatWhereTheContentDoesNot) {
  const std::string numbers = "0 0 0\n1 0 0\n0 1 0\n";
  const auto read = [&](const std::string& bytes, const char* name) {
    return read_points(std::string_view(bytes), name).report;
  };
  EXPECT_EQ(read(gzip_of(numbers), "a.xyz.gz").format, PointFormat::xyz);
  EXPECT_EQ(read(zstd_of(numbers), "a.txt.zst").packed.packing, Packing::zstd);
  EXPECT_EQ(read(zip_of({{"b/a.xyz", numbers}}), "a.zip").packed.entry, "b/a.xyz");
  EXPECT_EQ(read(zip_of({{"a.txt", numbers}}), "a.zip").packed.entry, "a.txt");
  // Not packed, whatever the name says.
  EXPECT_EQ(read(numbers, "a.xyz.gz").packed.packing, Packing::none);
  EXPECT_EQ(
      read_text(format_soup(tetrahedron(), SoupFormat::obj), "a.obj.gz").soup.triangles.size(), 4u);
}

class Watcher : public ProgressObserver {
 public:
  explicit Watcher(int questions) : questions_(questions) {}
  void advance(double share) override {
    EXPECT_GE(share, last_);
    EXPECT_LE(share, 1.0);
    last_ = share;
  }
  bool cancelled() override { return ++asked_ > questions_; }
  [[nodiscard]] int asked() const { return asked_; }

 private:
  int questions_;
  int asked_ = 0;
  double last_ = 0;
};

TEST(Packing, IsAskedWhetherToGoOn) {
  const std::string text(std::size_t{30} << 20, '#');
  for (const std::string& bytes : {gzip_of(text), zstd_of(text), zip_of({{"a.obj", text}})}) {
    ReadOptions options;
    Watcher patient(1 << 30);
    options.progress = &patient;
    EXPECT_THROW((void)read_soup(std::string_view(bytes), "a.obj", options), InputError);
    EXPECT_GT(patient.asked(), 20);
    Watcher hasty(5);
    options.progress = &hasty;
    EXPECT_THROW((void)read_soup(std::string_view(bytes), "a.obj", options), Cancelled);
  }
  Watcher hasty(5);
  for (const Packing packing : {Packing::gzip, Packing::zstd}) {
    EXPECT_THROW((void)pack_bytes(text, packing, &hasty), Cancelled);
  }
}

TEST(Packing, LimitsOfTrianglesHold) {
  ReadOptions options;
  options.max_triangles = 3;
  const std::string bytes = gzip_of(format_soup(tetrahedron(), SoupFormat::obj));
  EXPECT_THROW((void)read_soup(std::string_view(bytes), "a.obj.gz", options), LimitError);
}

}  // namespace
}  // namespace meshrepair
