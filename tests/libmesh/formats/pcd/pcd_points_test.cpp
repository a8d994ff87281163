// SPDX-License-Identifier: MIT
#include <cstring>
#include <string>

#include <gtest/gtest.h>

#include <base/error.h>
#include <mesh/point_io.h>

namespace meshrepair {
namespace {

const PointReadOptions kAll = {.colours = true};

PointReadResult read(const std::string& bytes) {
  return read_points(std::string_view(bytes), "cloud.pcd", kAll);
}

std::string failure_of(const std::string& bytes) {
  try {
    (void)read(bytes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no failure";
}

template <class Number>
std::string bytes_of(Number number) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

// Three fields of four bytes and, between them, one that means nothing.
std::string header(std::size_t points, const std::string& data) {
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y label z\n"
         "SIZE 4 4 2 4\nTYPE F F U F\nCOUNT 1 1 1 1\nWIDTH " +
         std::to_string(points) + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " +
         std::to_string(points) + "\nDATA " + data + "\n";
}

std::string record(float x, float y, float z) {
  return bytes_of(x) + bytes_of(y) + bytes_of(std::uint16_t{77}) + bytes_of(z);
}

// As LZF without any copies.
std::string packed(const std::string& bytes) {
  std::string out;
  for (std::size_t at = 0; at < bytes.size(); at += 32) {
    const std::string piece = bytes.substr(at, 32);
    out += static_cast<char>(piece.size() - 1);
    out += piece;
  }
  return bytes_of(static_cast<std::uint32_t>(out.size())) +
         bytes_of(static_cast<std::uint32_t>(bytes.size())) + out;
}

const std::vector<Vec3d> kTwo = {{1, 2, 3}, {4, 5, 6.5}};
const std::string kColumns = bytes_of(1.0F) + bytes_of(4.0F) + bytes_of(2.0F) + bytes_of(5.0F) +
                             std::string(4, '\7') + bytes_of(3.0F) + bytes_of(6.5F);

TEST(PcdPoints, AllEncodingsGiveTheSamePoints) {
  const PointReadResult ascii = read(header(2, "ascii") + "1 2 9 3\n4 5 9 6.5\n");
  EXPECT_EQ(ascii.cloud.points, kTwo);
  EXPECT_EQ(ascii.report.format, PointFormat::pcd_ascii);
  const PointReadResult binary = read(header(2, "binary") + record(1, 2, 3) + record(4, 5, 6.5F));
  EXPECT_EQ(binary.cloud.points, kTwo);
  EXPECT_EQ(binary.report.format, PointFormat::pcd_binary);
  const PointReadResult compressed = read(header(2, "binary_compressed") + packed(kColumns));
  EXPECT_EQ(compressed.cloud.points, kTwo);
  EXPECT_EQ(compressed.report.format, PointFormat::pcd_compressed);
}

TEST(PcdPoints, HaveNormalsAndPackedColours) {
  const std::string head =
      "VERSION .7\nFIELDS x y z rgb normal_x normal_y normal_z\nSIZE 8 8 8 4 4 4 4\n"
      "TYPE F F F U F F F\nWIDTH 1\nHEIGHT 1\n";
  const std::string body = bytes_of(1.0) + bytes_of(2.0) + bytes_of(3.0) +
                           bytes_of(std::uint32_t{0x0A0B0C}) + bytes_of(0.0F) + bytes_of(0.0F) +
                           bytes_of(1.0F);
  const PointReadResult result = read(head + "DATA binary\n" + body);
  EXPECT_EQ(result.cloud.normals, (std::vector<Vec3d>{{0, 0, 1}}));
  EXPECT_EQ(result.cloud.colours[0], (std::array<std::uint8_t, 3>{10, 11, 12}));
  const PointReadResult text = read(head + "DATA ascii\n1 2 3 658188 0 0 1\n");
  EXPECT_EQ(text.cloud.colours, result.cloud.colours);
}

// With alpha, the highest bit is the sign.
TEST(PcdPoints, ColoursMayHaveASign) {
  const std::string head =
      "VERSION .7\nFIELDS x y z rgba\nSIZE 4 4 4 4\nTYPE F F F I\nWIDTH 1\nHEIGHT 1\n";
  const PointReadResult text = read(head + "DATA ascii\n1 2 3 -32704\n");
  ASSERT_EQ(text.cloud.colours.size(), 1u);
  EXPECT_EQ(text.cloud.colours[0], (std::array<std::uint8_t, 3>{255, 128, 64}));
  const std::string body =
      bytes_of(1.0F) + bytes_of(2.0F) + bytes_of(3.0F) + bytes_of(std::int32_t{-32704});
  EXPECT_EQ(read(head + "DATA binary\n" + body).cloud.colours, text.cloud.colours);
}

TEST(PcdPoints, CountsAreBelievedAsFarAsTheBytesGo) {
  const PointReadResult cut =
      read(header(std::size_t{1} << 62, "binary") + record(1, 2, 3) + record(4, 5, 6.5F) + "xyz");
  EXPECT_EQ(cut.cloud.points, kTwo);
  EXPECT_EQ(cut.report.missing_points, (std::size_t{1} << 62) - 2);
  const PointReadResult longer = read(header(1, "binary") + record(1, 2, 3) + "abc");
  EXPECT_EQ(longer.report.trailing_bytes, 3U);
  const PointReadResult text = read(header(5, "ascii") + "1 2 9 3\n4 5\n4 5 9 6.5\n");
  EXPECT_EQ(text.cloud.points, kTwo);
  EXPECT_EQ(text.report.bad_points, 1U);
  EXPECT_EQ(text.report.missing_points, 2U);
}

TEST(PcdPoints, DamagedCompressionIsRefused) {
  std::string bytes = header(2, "binary_compressed") + packed(kColumns);
  EXPECT_EQ(failure_of(bytes.substr(0, bytes.size() - 1)),
            "cloud.pcd: the compressed points of the PCD file are cut");
  EXPECT_EQ(failure_of(header(3, "binary_compressed") + packed(kColumns)),
            "cloud.pcd: the compressed points of the PCD file are not as many as its header says");
  bytes[header(2, "binary_compressed").size() + 8] = '\xFF';
  EXPECT_EQ(failure_of(bytes), "cloud.pcd: the compressed points of the PCD file are damaged");
}

TEST(PcdPoints, HeadersThatMakeNoSenseAreRefusedInOneLine) {
  EXPECT_EQ(failure_of("VERSION 0.7\nFIELDS x y z\n"), "cloud.pcd: the PCD header has no DATA");
  EXPECT_EQ(failure_of("VERSION 0.7\nFROBNICATE\n"),
            "cloud.pcd:2: unknown word 'FROBNICATE' in the PCD header");
  EXPECT_EQ(failure_of("FIELDS x y\nSIZE 4 4\nTYPE F F\nPOINTS 1\nDATA ascii\n1 2\n"),
            "cloud.pcd: the points of the PCD file have no x, y and z");
  EXPECT_EQ(failure_of("FIELDS x y z\nSIZE 4 4\nTYPE F F F\nPOINTS 1\nDATA ascii\n1 2 3\n"),
            "cloud.pcd: FIELDS, SIZE, TYPE and COUNT of the PCD header have different numbers of "
            "entries");
  EXPECT_EQ(failure_of("FIELDS x y z\nSIZE 4 4 3\nTYPE F F F\nPOINTS 1\nDATA ascii\n1 2 3\n"),
            "cloud.pcd: the PCD field 'z' has an unknown type");
  EXPECT_EQ(failure_of("FIELDS x y z\nSIZE 4 4 -3\n"),
            "cloud.pcd:2: a number of the PCD header is none");
  EXPECT_EQ(failure_of("FIELDS x y z\nDATA zip\n"), "cloud.pcd:2: unknown PCD data 'zip'");
  EXPECT_EQ(failure_of(header(0, "ascii")), "cloud.pcd: holds no readable points");
}

}  // namespace
}  // namespace meshrepair
